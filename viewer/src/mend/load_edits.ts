import type { Load, LoadBox } from "holdfast-engine";

/** Edits of a load: each gives another load, and leaves the old one as it is. Whether boxes may be there the engine tells. */

/** A side of the container, by its axis and whether it is at its far end. */
export interface Side {
  axis: number;
  far: boolean;
}

/** m: less than this apart, faces touch. */
export const TOUCHING = 1e-6;
/** m: a gap up to which a box stands at a wall, on the floor or on another box, as the program takes it. */
export const NEAR = 0.01;
/** Coefficient of friction of the anti-slip mats that are laid: what their makers state, and CTU Code 2014 asks them to show. */
export const MAT = 0.6;

/** What is told of places is no finer than a tenth of a micrometre. */
const round = (value: number) => Math.round(value * 1e7) / 1e7;

export const low = (box: LoadBox, axis: number) => box.corner_min[axis];
export const high = (box: LoadBox, axis: number) => box.corner_max[axis];
const extent = (box: LoadBox, axis: number) => high(box, axis) - low(box, axis);

/** The load with something else said of a box. */
export function changed(load: Load, box: number, change: Partial<LoadBox>): Load {
  const boxes = load.boxes.slice();
  boxes[box] = { ...boxes[box], ...change };
  return { ...load, boxes };
}

/** The load with the corner of a box elsewhere, m. */
export function placedAt(load: Load, box: number, corner: readonly number[]): Load {
  const of = load.boxes[box];
  const corner_min = corner.map(round) as LoadBox["corner_min"];
  const corner_max = corner.map((value, axis) => round(value + extent(of, axis))) as LoadBox["corner_max"];
  return changed(load, box, { corner_min, corner_max });
}

export function moved(load: Load, box: number, axis: number, by: number): Load {
  const corner = load.boxes[box].corner_min.slice();
  corner[axis] += by;
  return placedAt(load, box, corner);
}

/** Length and width exchanged, about the corner at the front and the left. */
export function turned(load: Load, box: number): Load {
  const { corner_min, corner_max, centre_of_mass } = load.boxes[box];
  const [length, width] = [0, 1].map((axis) => extent(load.boxes[box], axis));
  const change: Partial<LoadBox> = {
    corner_max: [round(corner_min[0] + width), round(corner_min[1] + length), corner_max[2]],
  };
  if (centre_of_mass) change.centre_of_mass = [-centre_of_mass[1], centre_of_mass[0], centre_of_mass[2]];
  return changed(load, box, change);
}

/** With an anti-slip mat beneath boxes, or without one. */
export function withMats(load: Load, boxes: readonly number[], mat: number | undefined): Load {
  return boxes.reduce((next, box) => changed(next, box, { mat }), load);
}

export const without = (load: Load, box: number): Load => ({
  ...load,
  boxes: load.boxes.filter((_, index) => index !== box),
});

/** Whether two boxes face each other along an axis: they overlap across it. */
const faces = (a: LoadBox, b: LoadBox, axis: number) =>
  [0, 1, 2].every(
    (other) =>
      other === axis || Math.min(high(a, other), high(b, other)) > Math.max(low(a, other), low(b, other)) + TOUCHING,
  );

const overlaps = (a: LoadBox, b: LoadBox) =>
  [0, 1, 2].every((axis) => Math.min(high(a, axis), high(b, axis)) > Math.max(low(a, axis), low(b, axis)) + TOUCHING);

/** A box moved towards a side until it touches the wall or one of these boxes. */
function pushed(box: LoadBox, others: readonly LoadBox[], { axis, far }: Side, size: readonly number[]): number {
  const inTheWay = others.filter(
    (other) =>
      faces(box, other, axis) &&
      (far ? low(other, axis) >= high(box, axis) - TOUCHING : high(other, axis) <= low(box, axis) + TOUCHING),
  );
  return far
    ? Math.min(size[axis], ...inTheWay.map((other) => low(other, axis))) - extent(box, axis)
    : Math.max(0, ...inTheWay.map((other) => high(other, axis)));
}

/** The load with a box against the wall of a side, or against what stands between. */
export function against(load: Load, box: number, side: Side, size: readonly number[]): Load {
  const others = load.boxes.filter((_, index) => index !== box);
  const corner = load.boxes[box].corner_min.slice();
  corner[side.axis] = pushed(load.boxes[box], others, side, size);
  return placedAt(load, box, corner);
}

/** The load with all boxes moved towards a side until they touch, those that are nearest to it first. */
export function closedUp(load: Load, side: Side, size: readonly number[], isFixed: (box: number) => boolean): Load {
  const distance = (box: LoadBox) => (side.far ? size[side.axis] - high(box, side.axis) : low(box, side.axis));
  const order = [...load.boxes.keys()].sort((a, b) => distance(load.boxes[a]) - distance(load.boxes[b]));
  return order.filter((box) => !isFixed(box)).reduce((next, box) => against(next, box, side, size), load);
}

/** Whether a box stands on another one. */
const standsOn = (box: LoadBox, other: LoadBox) =>
  Math.abs(low(box, 2) - high(other, 2)) < NEAR && faces(box, other, 2);

/** Whether another box stands on a box. */
export const carries = (load: Load, box: number) => load.boxes.some((other) => standsOn(other, load.boxes[box]));

/** Whether nothing is beneath a box. */
const floats = (load: Load, box: number) =>
  low(load.boxes[box], 2) >= NEAR && !load.boxes.some((other) => standsOn(load.boxes[box], other));

/** Boxes that have nothing beneath them in a load, and had something in the same load before. */
export const leftFloating = (before: Load, after: Load): number[] =>
  [...after.boxes.keys()].filter((box) => floats(after, box) && !floats(before, box));

/**
 * The load with two boxes in each other's place. The lower corner at the front and the left stays; where a box stood at the rear wall
 * or the right one alone, the other one comes to that wall. Of two boxes that stood on each other, the upper one stands on the lower one again.
 */
export function swapped(load: Load, a: number, b: number, size: readonly number[]): Load {
  const into = (place: LoadBox, box: LoadBox) =>
    [0, 1, 2].map((axis) => {
      const isAtFarWall = axis !== 2 && size[axis] - high(place, axis) < NEAR && low(place, axis) >= NEAR;
      return isAtFarWall ? size[axis] - extent(box, axis) : low(place, axis);
    });
  const [first, second] = [load.boxes[a], load.boxes[b]];
  const [ofFirst, ofSecond] = [into(second, first), into(first, second)];
  if (standsOn(second, first)) ofFirst[2] = ofSecond[2] + extent(second, 2);
  if (standsOn(first, second)) ofSecond[2] = ofFirst[2] + extent(first, 2);
  return placedAt(placedAt(load, a, ofFirst), b, ofSecond);
}

/** The load with a box that stands on others on the floor, as near as there is room; null: it cannot, or there is none. */
export function lowered(load: Load, box: number, size: readonly number[]): Load | null {
  if (low(load.boxes[box], 2) < NEAR || carries(load, box)) return null;
  const others = load.boxes.filter((_, index) => index !== box);
  let best: { load: Load; distance: number } | null = null;
  for (const shape of [load, turned(load, box)]) {
    const of = shape.boxes[box];
    const stops = (axis: number) => [
      0,
      size[axis] - extent(of, axis),
      ...others.flatMap((other) => [high(other, axis), low(other, axis) - extent(of, axis)]),
    ];
    for (const x of stops(0))
      for (const y of stops(1)) {
        const inside =
          x >= 0 && y >= 0 && x + extent(of, 0) <= size[0] + TOUCHING && y + extent(of, 1) <= size[1] + TOUCHING;
        const distance = Math.hypot(x - low(of, 0), y - low(of, 1));
        if (!inside || (best && distance >= best.distance)) continue;
        const there = placedAt(shape, box, [x, y, 0]);
        if (!others.some((other) => overlaps(there.boxes[box], other))) best = { load: there, distance };
      }
  }
  return best?.load ?? null;
}

/** Whether two loads are the same. */
export const isSame = (a: Load, b: Load) => JSON.stringify(a) === JSON.stringify(b);
