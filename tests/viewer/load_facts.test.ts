import assert from "node:assert/strict";
import { test } from "node:test";
import { centreOfGravity, centreRange, itemsOf, massOf, neededMargins } from "../../viewer/src/data/load_facts";
import type { BoxColumns, Results } from "../../viewer/src/data/results";
import { damageIndices } from "../../viewer/src/load/quantities";
import { fittingLabel } from "../../viewer/src/print/box_label";
import { rangesText, rowsFor } from "../../viewer/src/print/sheet";

const boxes = {
  fixed: Uint8Array.of(1, 0, 0, 0),
  mass: Float32Array.of(500, 100, 100, 200),
  initial: Float32Array.of(9, 9, 9, 1, 1, 1, 3, 1, 1, 2, 2, 0.5),
  name: ["bulkhead", "Paper 1", "Paper 2", ""],
  material: ["2", "1", "1", "steel"],
  size: Float32Array.of(1, 1, 1, 0.8, 1.2, 1, 0.8, 1.2, 1, 1, 1, 1),
} as unknown as BoxColumns;

test("mass and centre of gravity are of the load, without what is part of the container", () => {
  assert.equal(massOf(boxes), 400);
  assert.deepEqual(centreOfGravity(boxes), [2, 1.5, 0.75]);
  const weightless = { ...boxes, fixed: Uint8Array.of(1, 1, 1, 1) };
  assert.equal(centreOfGravity(weightless), null);
});

test("a container's centre of gravity may lie within a twentieth of its length from the middle; of a trailer axles say it", () => {
  assert.deepEqual(centreRange({ type: "", size: [10, 2, 2] }), [4.5, 5.5]);
  assert.ok(centreRange({ type: "40hc", size: [12, 2, 2] }));
  assert.equal(centreRange({ type: "trailer-box", size: [13.6, 2, 2] }), null);
});

test("boxes are items by name and size", () => {
  assert.deepEqual(
    itemsOf(boxes).map(({ name, masses }) => [name, ...masses]),
    [
      ["Paper", 100, 100],
      ["steel", 200],
    ],
  );
});

test("a norm asks for a margin by the accelerations that leave the load its weight", () => {
  const segment = (...value: number[]) => ({ start: 0, duration: 1, value });
  const segments = [[segment(2.943, 0, -4.905)], [segment(1.962, 0, 0)], [segment(0, -4.905, 0)], [segment(0, 7, 0)]];
  // That of a file asks for nothing.
  const accelerations = ["sea-a-front-0g3", "sea-a-front-0g2", "sea-a-right-0g5", "sea-a-left.txt"];
  const needed = (settings: Record<string, string>) =>
    neededMargins({ settings, accelerations, segments } as unknown as Results);
  assert.deepEqual(
    needed({ "Screening/Norm": "sea-a" }).map((size) => Number(size.toFixed(6))),
    [0.2, 0, 0, 0.5],
  );
  assert.deepEqual(needed({}), [0, 0, 0, 0]);
});

test("a label is the name where it fits, in lines where it must, else the number, else nothing", () => {
  const box = { name: "Paper 1", number: 12 };
  assert.deepEqual(fittingLabel(box, 40, 20), ["Paper 1"]);
  assert.deepEqual(fittingLabel(box, 25, 20), ["Paper", "1"]);
  assert.deepEqual(fittingLabel(box, 25, 12), ["12"]);
  assert.deepEqual(fittingLabel(box, 20, 20), ["12"]);
  assert.deepEqual(fittingLabel(box, 40, 6), []);
  assert.deepEqual(fittingLabel({ name: "", number: 3 }, 40, 20), ["3"]);
});

test("tables share the room of a page evenly, and have more rows where a second page is needed anyway", () => {
  assert.deepEqual(rowsFor(20, [30, 2]), [10, 2]);
  assert.deepEqual(rowsFor(20, [30, 30]), [6, 6]);
  assert.deepEqual(rowsFor(20, [0, 5]), [0, 5]);
  assert.deepEqual(rowsFor(12, [1, 30]), [1, 3]);
  assert.ok(rowsFor(4, [30, 30])[0] > 3);
});

test("numbers of boxes that follow each other are told together", () => {
  assert.equal(rangesText([1, 2, 3, 7, 8, 10]), "1 to 3, 7, 8, 10");
  assert.equal(rangesText([1, 3, 5, 7, 9, 11, 13, 15, 17]), "1, 3, 5, 7, 9, 11, 13, 15, …");
});

test("a box is at the damage boundary where the lesser of its two numbers is", () => {
  const damage = {
    acceleration: Float32Array.of(30 * 9.81, 7.5 * 9.81, 0),
    velocityChange: Float32Array.of(0.5, 4, 0),
    beyond: new Uint8Array(3),
  };
  const indices = damageIndices(damage, { acceleration: 15, velocityChange: 1 });
  assert.deepEqual(
    Array.from(indices, (index) => Number(index.toFixed(4))),
    [0.5, 0.5, 0],
  );
});
