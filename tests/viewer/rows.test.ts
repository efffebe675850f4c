import assert from "node:assert/strict";
import { test } from "node:test";
import { STOP_REASON_CODES, VERDICT_CODES } from "../../viewer/src/data/outcome";
import type { Results } from "../../viewer/src/data/results";
import { arranged, type Row, rowsOf } from "../../viewer/src/fleet/rows";
import { fromHash, START, toHash } from "../../viewer/src/ui/state";

const row = (layout: number, badness: number, displacement: number, margin: number): Row => ({
  layout,
  worlds: new Int32Array(1),
  badness,
  failing: [0, badness, 0],
  displacement,
  margin,
});
const names = ["b10", "b9", "a", "wall"];
const rows = [row(0, 3, 0.2, 0.5), row(1, 5, 0.1, Number.NaN), row(2, 3, 0.4, 0.1), row(3, 1, 0, 0.9)];
const order = (sort: "worst" | "margin" | "name", filter = "") =>
  arranged(rows, names, filter, sort).map((r) => r.layout);

test("rows are sorted by what is worst, smallest, first", () => {
  assert.deepEqual(order("worst"), [1, 2, 0, 3]);
  assert.deepEqual(order("name"), [2, 1, 0, 3]);
  assert.deepEqual(order("margin"), [2, 0, 3, 1]);
});

test("most boxes with the worst verdict come first, then with the next one: 18 that fell before 2", () => {
  const { stayed, moved, fell } = VERDICT_CODES;
  // Per layout and acceleration: verdict, boxes that fell, boxes that moved, and the largest displacement, m.
  const worlds = [
    [fell, 1, 1, 3, stayed, 0, 0, 0],
    [fell, 2, 2, 1, moved, 0, 1, 0.2],
    [fell, 2, 2, 1, moved, 0, 9, 0.2],
    [moved, 0, 20, 4, moved, 0, 20, 4],
    [fell, 1, 1, 1, fell, 1, 1, 1],
    [fell, 18, 18, 1, stayed, 0, 0, 0],
  ].flatMap((row, layout) => [
    { layout, acceleration: 0, verdict: row[0], fallen: row[1], moved: row[2], far: row[3] },
    { layout, acceleration: 1, verdict: row[4], fallen: row[5], moved: row[6], far: row[7] },
  ]);
  const column = (key: keyof (typeof worlds)[0]) => Uint32Array.from(worlds, (world) => world[key]);
  const results = {
    layouts: ["a", "b", "c", "d", "e", "f"],
    accelerations: ["x", "y"],
    judgedAtEnd: false,
    margins: null,
    worlds: {
      layout: column("layout"),
      acceleration: column("acceleration"),
      verdict: column("verdict"),
      fallen: column("fallen"),
      moved: column("moved"),
      tilted: new Uint32Array(12),
      unstable: new Uint32Array(12),
      stopReason: new Uint8Array(12).fill(STOP_REASON_CODES.sleeping),
      peakDisplacement: Float32Array.from(worlds, ({ far }) => far),
    },
  } as unknown as Results;
  const sorted = arranged(rowsOf(results), results.layouts, "", "worst").map((r) => results.layouts[r.layout]);
  assert.deepEqual(sorted, ["f", "c", "b", "e", "a", "d"]);
});

test("a cell of margins says the largest that is tried with a plus, and what is unstable in words", async () => {
  // Colours are those of a page, which is not there.
  const nothing = { addEventListener: () => {}, dataset: {}, getPropertyValue: () => "" };
  const page = { matchMedia: () => nothing, getComputedStyle: () => nothing, document: { documentElement: nothing } };
  Object.assign(globalThis, page);
  const { cellOf } = await import("../../viewer/src/fleet/scales");
  const margin = Float64Array.of(1.5, 0.505, -0.2, Number.NaN);
  const columns = { margin, criticalBox: new Uint32Array(4) };
  const results = { margins: { inPlace: columns, withinLimits: columns } } as unknown as Results;
  const texts = [0, 1, 2, 3].map((column) => cellOf(results, rows[0], column, "margin")?.text ?? null);
  assert.deepEqual(texts, ["1.50+", "0.50", "unstable", null]);
});

test("a filter wants all of its words", () => {
  assert.deepEqual(order("name", "B"), [1, 0]);
  assert.deepEqual(order("name", "b 1"), [0]);
});

test("boxes and worlds count from 1 in the address", () => {
  assert.equal(toHash({ ...START, world: 0, other: 3, box: 59 }), "world=1&other=4&box=60");
  const { world, other, box } = fromHash("#world=1&other=4&box=60");
  assert.deepEqual([world, other, box], [0, 3, 59]);
  for (const nonsense of ["0", "-1", "1.5"]) {
    assert.equal(fromHash(`#world=1&box=${nonsense}`).box, null);
    assert.equal(fromHash(`#world=${nonsense}`).world, null);
  }
});

test("the address says what is shown, and nothing that is so anyway", () => {
  const state = { ...START, world: 0, box: 3, time: 1.25, ghost: true, filter: "a b" };
  assert.deepEqual(fromHash(`#${toHash(state)}`), state);
  assert.equal(toHash(START), "");
  assert.deepEqual(fromHash("#world=x&nonsense=1"), START);
});
