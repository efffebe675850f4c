import assert from "node:assert/strict";
import { test } from "node:test";
import { arranged, type Row } from "../../viewer/src/fleet/rows";
import { fromHash, START, toHash } from "../../viewer/src/ui/state";

const row = (layout: number, badness: number, displacement: number, margin: number): Row => ({
  layout,
  worlds: new Int32Array(1),
  badness,
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

test("a filter wants all of its words", () => {
  assert.deepEqual(order("name", "B"), [1, 0]);
  assert.deepEqual(order("name", "b 1"), [0]);
});

test("boxes count from 1 in the address", () => {
  assert.equal(toHash({ ...START, world: 0, box: 59 }), "world=0&box=60");
  assert.equal(fromHash("#world=0&box=60").box, 59);
  assert.equal(fromHash("#world=0&box=0").box, null);
});

test("the address says what is shown, and nothing that is so anyway", () => {
  const state = { ...START, world: 0, box: 3, time: 1.25, ghost: true, filter: "a b" };
  assert.deepEqual(fromHash(`#${toHash(state)}`), state);
  assert.equal(toHash(START), "");
  assert.deepEqual(fromHash("#world=x&nonsense=1"), START);
});
