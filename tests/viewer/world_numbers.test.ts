import assert from "node:assert/strict";
import { test } from "node:test";
import { freeWay, supported } from "../../viewer/src/box/cause";
import type { BoxColumns, World } from "../../viewer/src/data/results";
import { accelerationAt } from "../../viewer/src/time/acceleration";
import { firstMoves, orderOfMoves } from "../../viewer/src/time/first_moves";
import { between, slerp } from "../../viewer/src/time/poses";

test("a time lies between two samples", () => {
  const time = Float64Array.of(0, 0.1, 0.3);
  assert.deepEqual(between(time, -1), { sample: 0, share: 0 });
  assert.deepEqual(between(time, 0.1), { sample: 1, share: 0 });
  assert.equal(between(time, 0.2).sample, 1);
  assert.ok(Math.abs(between(time, 0.2).share - 0.5) < 1e-12);
  assert.deepEqual(between(time, 9), { sample: 2, share: 0 });
});

test("half way between two rotations is half the angle, the short way round", () => {
  const half = Math.SQRT1_2;
  for (const sign of [1, -1]) {
    const q = Float32Array.of(1, 0, 0, 0, sign * half, 0, 0, sign * half);
    const out = new Float32Array(4);
    slerp(q, 0, 4, 0.5, out, 0);
    assert.ok(Math.abs(out[2] - Math.sin(Math.PI / 8)) < 1e-6);
    assert.ok(Math.abs(out[3] - Math.cos(Math.PI / 8)) < 1e-6);
  }
});

test("segments of an acceleration hold from their start to before their end", () => {
  const segments = [{ start: 0.5, duration: 1, value: [7.848, 0, 0] as [number, number, number] }];
  assert.equal(accelerationAt(segments, 0.49)[0], 0);
  assert.equal(accelerationAt(segments, 0.5)[0], 7.848);
  assert.equal(accelerationAt(segments, 1.5)[0], 0);
});

/** Boxes from their lowest corners and sizes, m. */
function boxesOf(list: { at: number[]; size: number[] }[]): BoxColumns {
  return {
    id: Uint32Array.from(list, (_, i) => i + 1),
    size: Float32Array.from(list.flatMap(({ size }) => size)),
    reference: Float32Array.from(list.flatMap(({ at, size }) => at.map((low, axis) => low + size[axis] / 2))),
  } as unknown as BoxColumns;
}

const pile = boxesOf([
  { at: [1, 0, 0], size: [1, 1, 1] },
  { at: [2.2, 0, 0], size: [1, 1, 1] },
  { at: [1.5, 0, 1], size: [1, 1, 0.5] },
]);

test("the way of a box is free until the next box or the wall", () => {
  const container = [6, 2.4, 2.4];
  assert.ok(Math.abs(freeWay(pile, container, 0, 0, true) - 0.2) < 1e-5);
  assert.ok(Math.abs(freeWay(pile, container, 0, 0, false) - 1) < 1e-5);
  assert.ok(Math.abs(freeWay(pile, container, 1, 0, true) - 2.8) < 1e-5);
});

test("a base is supported by what it stands on", () => {
  assert.equal(supported(pile, 0), 1);
  assert.ok(Math.abs(supported(pile, 2) - 0.8) < 1e-5);
});

test("who moves first comes first", () => {
  // Three samples of two boxes: the second moves 2 cm in the first step, the first box in the next.
  const displacement = new Float32Array(18);
  displacement[3 * 3] = 0.02;
  displacement[3 * 4] = 0.03;
  displacement[3 * 5] = 0.05;
  const orientation = Float32Array.from({ length: 24 }, (_, i) => (i % 4 === 0 ? 1 : 0));
  const world = {
    boxes: { id: Uint32Array.of(1, 2) },
    series: { time: Float64Array.of(0, 0.1, 0.2), displacement, orientation },
  } as unknown as World;
  const first = firstMoves(world, { move: 0.1, drop: 0.05, tilt: 10 });
  assert.deepEqual([...first], [2, 1]);
  assert.deepEqual(orderOfMoves(world, first), [1, 0]);
});
