/** The faces of boxes that a view of a load sees, in the order in which they are painted. */

export type View = "top" | "side" | "rear" | "front" | "corner";

export type Point = readonly number[];
/** A face of a box: the axis that it is across, and whether it is the one with the larger coordinate. */
export type Face = readonly [axis: number, far: boolean];

/** m: corners with the smallest and the largest coordinates */
export interface Bounds {
  low: Point;
  high: Point;
}

export interface PaintedFace {
  /** m */
  corners: Point[];
  /** 1: as bright as its colour */
  shade: number;
}

/** Faces of a box by its index. */
export interface PaintedBox {
  box: number;
  faces: PaintedFace[];
}

export const FACES: Record<View, readonly Face[]> = {
  top: [[2, true]],
  side: [[1, false]],
  rear: [[0, true]],
  front: [[0, false]],
  corner: [
    [0, true],
    [1, false],
    [2, true],
  ],
};
/** Of faces across each axis. */
export const SHADES = [0.86, 0.93, 1] as const;

/** Boxes of which it is found which one hides which; more are painted by distance. */
const MOST_ORDERED = 1500;
/** m around the container in which boxes are drawn that have left it */
export const SURROUNDINGS = 5;

export function corners({ low, high }: Bounds, [axis, far]: Face): Point[] {
  const others = [0, 1, 2].filter((other) => other !== axis);
  return [
    [0, 0],
    [1, 0],
    [1, 1],
    [0, 1],
  ].map((square) => {
    const corner = [...low];
    corner[axis] = (far ? high : low)[axis];
    for (const [i, other] of others.entries()) corner[other] = (square[i] ? high : low)[other];
    return corner;
  });
}

/** Whether box a can be hidden by box b, and never the other way round: on some axis it lies on the far side of it. */
const isBehind = (a: Bounds, b: Bounds, view: View) =>
  FACES[view].some(([axis, far]) => (far ? a.high[axis] <= b.low[axis] + 1e-4 : b.high[axis] <= a.low[axis] + 1e-4));

/** Boxes in the order in which they are painted. Boxes that do not overlap have one, but for rare rings. */
function backToFront(boxes: readonly Bounds[], view: View): number[] {
  const all = [...boxes.keys()];
  const byNearness = (nearness: (box: Bounds) => number) => all.sort((a, b) => nearness(boxes[a]) - nearness(boxes[b]));
  if (view !== "corner") {
    const [[axis, far]] = FACES[view];
    return byNearness(({ low, high }) => (far ? high[axis] : -low[axis]));
  }
  if (boxes.length > MOST_ORDERED) return byNearness(({ low, high }) => high[0] - low[1] + high[2]);
  const before = all.map((i) =>
    all.filter((j) => j !== i && isBehind(boxes[j], boxes[i], view) && !isBehind(boxes[i], boxes[j], view)),
  );
  const order: number[] = [];
  const left = new Set(all);
  const waits = (i: number) => before[i].filter((j) => left.has(j)).length;
  while (left.size > 0) {
    const ready = [...left].filter((i) => waits(i) === 0);
    const next = ready.length > 0 ? ready : [[...left].reduce((best, i) => (waits(i) < waits(best) ? i : best))];
    order.push(...next);
    for (const i of next) left.delete(i);
  }
  return order;
}

/** Of boxes that stand upright. */
export const packedFaces = (boxes: readonly Bounds[], view: View): PaintedBox[] =>
  backToFront(boxes, view).map((box) => ({
    box,
    faces: FACES[view].map((face) => ({
      corners: corners(boxes[box], face),
      shade: view === "corner" ? SHADES[face[0]] : 1,
    })),
  }));

/** A box that has turned: as loaded, from its centre of mass; the quaternion w, x, y, z; and where that centre is, m. */
export interface TurnedBox {
  loaded: Bounds;
  turn: readonly number[];
  centre: Point;
}

/** Columns of the matrix of a quaternion w, x, y, z: where the axes of a box point. */
function axesOf(turn: readonly number[]): Point[] {
  const length = Math.hypot(...turn);
  const [w, x, y, z] = turn.map((part) => part / length);
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
  ];
}

const dot = (a: Point, b: Point) => a.reduce((sum, part, axis) => sum + part * b[axis], 0);

/** Of boxes that have turned, by the distances of their centres. */
export function turnedFaces(boxes: readonly TurnedBox[], view: View): PaintedBox[] {
  const toViewer = [0, 0, 0];
  for (const [axis, far] of FACES[view]) toViewer[axis] = far ? 1 : -1;
  const nearness = ({ box }: PaintedBox) => dot(boxes[box].centre, toViewer);
  const all = boxes.map(({ loaded, turn, centre }, box): PaintedBox => {
    const axes = axesOf(turn);
    const place = (point: Point) =>
      [0, 1, 2].map((row) => centre[row] + axes.reduce((sum, axis, i) => sum + axis[row] * point[i], 0));
    const faces = axes.flatMap((axis, i) =>
      [false, true].flatMap((far): PaintedFace[] => {
        if ((far ? 1 : -1) * dot(axis, toViewer) <= 1e-6) return [];
        const steepness = axis.map(Math.abs);
        const shade = SHADES[steepness.indexOf(Math.max(...steepness))];
        return [{ corners: corners(loaded, [i, far]).map(place), shade }];
      }),
    );
    return { box, faces };
  });
  return all.sort((a, b) => nearness(a) - nearness(b));
}

/** Where a painted box is. */
export function middleOf({ faces }: PaintedBox): Point {
  const points = faces.flatMap((face) => face.corners);
  return [0, 1, 2].map((axis) => points.reduce((sum, point) => sum + point[axis], 0) / points.length);
}

/** Whether a box with its centre there is so near to a container that it is drawn with it. */
export const isNear = ([x, y]: Point, [length, width]: readonly number[]) =>
  Math.max(-x, x - length, -y, y - width) < SURROUNDINGS;
