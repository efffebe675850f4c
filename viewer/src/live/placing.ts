/** Puts a box of a layout elsewhere, before a world starts. Boxes are rows of seven numbers, m. */

/** m: a face that comes this near another one touches it. */
const NEAR = 0.03;
/** m: what is not put against something is put on this grid. */
const GRID = 0.001;

const low = (boxes: Float64Array, box: number, axis: number) => boxes[7 * box + axis];
const high = (boxes: Float64Array, box: number, axis: number) => boxes[7 * box + 3 + axis];

/** Whether two boxes face each other along an axis: they overlap across it. */
function face(boxes: Float64Array, a: number, b: number, axis: number): boolean {
  return [0, 1, 2]
    .filter((other) => other !== axis)
    .every(
      (other) =>
        Math.min(high(boxes, a, other), high(boxes, b, other)) >
        Math.max(low(boxes, a, other), low(boxes, b, other)) + 1e-9,
    );
}

/** The layout with the corner of a box elsewhere. */
export function placed(boxes: Float64Array, box: number, corner: readonly number[]): Float64Array {
  const next = boxes.slice();
  for (let axis = 0; axis < 3; ++axis) {
    const size = high(boxes, box, axis) - low(boxes, box, axis);
    // The size stays what it is to a tenth of a micrometre, in numbers that a layout file can have.
    next[7 * box + axis] = round(corner[axis]);
    next[7 * box + 3 + axis] = round(corner[axis] + size);
  }
  return next;
}

const round = (value: number) => Math.round(value * 1e7) / 1e7;

/** The same, moved by (x, y) on its level; against a wall or a box that it comes near. */
export function dragged(
  boxes: Float64Array,
  box: number,
  by: readonly [number, number],
  container: readonly number[],
): Float64Array {
  const corner = [0, 1, 2].map((axis) => low(boxes, box, axis));
  for (const axis of [0, 1]) corner[axis] = Math.round((corner[axis] + by[axis]) / GRID) * GRID;
  for (const axis of [0, 1]) {
    const size = high(boxes, box, axis) - low(boxes, box, axis);
    // Walls hold the pointer; numbers that are typed can be wrong.
    corner[axis] = Math.max(0, Math.min(container[axis] - size, corner[axis]));
    const there = placed(boxes, box, corner);
    const stops = [0, container[axis] - size];
    for (let other = 0; 7 * other < boxes.length; ++other)
      if (other !== box && face(there, box, other, axis))
        stops.push(high(boxes, other, axis), low(boxes, other, axis) - size);
    const nearest = stops.reduce((best, stop) =>
      Math.abs(stop - corner[axis]) < Math.abs(best - corner[axis]) ? stop : best,
    );
    if (Math.abs(nearest - corner[axis]) < NEAR) corner[axis] = nearest;
  }
  return placed(boxes, box, corner);
}
