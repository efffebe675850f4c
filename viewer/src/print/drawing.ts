import { isClosed, isFull, type Openings, UPRIGHT } from "../data/openings";
import type { Size } from "../data/results";

/** Draws a load as it was packed, for print, as `holdfast report` does (tools/load_views.py): with its colours, views and labels. */

export type View = "top" | "side" | "corner";

export const FILLS = { still: "#e9edf2", later: "#f3c58b", first: "#d9534f", fixed: "#949da8" } as const;
export type State = keyof typeof FILLS;

const LINE = "#5a6470";
const FRAME = "#222831";
const BED = "#dfe2e6";
const GROUND = "#f3f4f6";
/** m around the container that the ground is drawn for */
const GROUND_MARGIN = 0.5;
/** Pixels: a page has room for pictures that are so high. */
const HIGHEST: Record<View, number> = { top: 140, side: 140, corner: 260 };
/** Pixels: letters of labels, and the share of that which a letter is wide. */
const LETTER = 7;
const LETTER_WIDTH = 0.56;
/** Boxes of which it is found which one hides which; more are painted by distance. */
const MOST_ORDERED = 1500;

type Point = readonly number[];
/** A face of a box: the axis that it is across, and whether it is the one with the larger coordinate. */
type Face = readonly [axis: number, far: boolean];

/** Where a point of the container goes on the page: to the right, and up. */
const PROJECTIONS: Record<View, readonly [Point, Point]> = {
  top: [
    [1, 0, 0],
    [0, 1, 0],
  ],
  side: [
    [1, 0, 0],
    [0, 0, 1],
  ],
  // From above the door, on the left.
  corner: [
    [0.87, 0.5, 0],
    [-0.3, 0.4, 0.85],
  ],
};
const FACES: Record<View, readonly Face[]> = {
  top: [[2, true]],
  side: [[1, false]],
  corner: [
    [0, true],
    [1, false],
    [2, true],
  ],
};
const SHADES = [0.86, 0.93, 1];

export interface PackedBox {
  /** m */
  low: Point;
  high: Point;
  state: State;
  number: number;
  /** empty: it has none */
  name: string;
}

function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number>,
  ...children: (Node | string)[]
): SVGElementTagNameMap[K] {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, String(value));
  node.append(...children);
  return node;
}

function corners(low: Point, high: Point, [axis, far]: Face): Point[] {
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
const isBehind = (a: PackedBox, b: PackedBox, view: View) =>
  FACES[view].some(([axis, far]) => (far ? a.high[axis] <= b.low[axis] + 1e-4 : b.high[axis] <= a.low[axis] + 1e-4));

/** Boxes in the order in which they are painted. Boxes that do not overlap have one, but for rare rings. */
function backToFront(boxes: readonly PackedBox[], view: View): number[] {
  const all = [...boxes.keys()];
  if (view === "top") return all.sort((a, b) => boxes[a].high[2] - boxes[b].high[2]);
  if (view === "side") return all.sort((a, b) => boxes[b].low[1] - boxes[a].low[1]);
  const nearness = ({ low, high }: PackedBox) => high[0] - low[1] + high[2];
  if (boxes.length > MOST_ORDERED) return all.sort((a, b) => nearness(boxes[a]) - nearness(boxes[b]));
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

function shaded(colour: string, shade: number): string {
  const parts = [1, 3, 5].map((i) => Math.round(shade * Number.parseInt(colour.slice(i, i + 2), 16)));
  return `#${parts.map((part) => part.toString(16).padStart(2, "0")).join("")}`;
}

const polygon = (points: readonly Point[], attributes: Record<string, string | number>) =>
  svg("polygon", { points: points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" "), ...attributes });

/** The label that fits into a face of so many pixels: the name, else the number, else nothing. */
export function fittingLabel(
  { name, number }: Pick<PackedBox, "name" | "number">,
  width: number,
  height: number,
): string {
  const fits = (text: string) => LETTER <= height - 2 && LETTER_WIDTH * LETTER * text.length <= width - 3;
  return [name, String(number)].find((text) => text !== "" && fits(text)) ?? "";
}

interface Rectangle {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

function boundsOf(points: readonly Point[]): Rectangle {
  const [x, y] = [0, 1].map((i) => points.map((point) => point[i]));
  return { left: Math.min(...x), right: Math.max(...x), top: Math.min(...y), bottom: Math.max(...y) };
}

const meet = (a: Rectangle, b: Rectangle) =>
  a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/** A label in the middle of a face. */
function label(text: string, bounds: Rectangle): SVGElement {
  const [x, y] = [(bounds.left + bounds.right) / 2, (bounds.top + bounds.bottom) / 2 + 0.35 * LETTER];
  const place = { x: x.toFixed(1), y: y.toFixed(1), "font-size": LETTER, "text-anchor": "middle" };
  return svg("text", { ...place, fill: FRAME }, text);
}

/**
 * A container with its boxes.
 * @param size m, of the container
 * @param room pixels that it may be wide
 */
export function drawLoad(
  boxes: readonly PackedBox[],
  size: Size,
  openings: Openings,
  view: View,
  room: number,
): SVGElement {
  const [right, up] = PROJECTIONS[view];
  const closed = isClosed(openings, size[2]);
  const inside: readonly [Point, Point] = [[0, 0, 0], size];
  const bed = !closed && openings.bedHeight > 0 ? openings.bedHeight : 0;
  const margin = bed > 0 && view === "corner" ? GROUND_MARGIN : 0;
  const low = [-margin, -margin, -bed];
  const high = [size[0] + margin, size[1] + margin, size[2]];
  const flat = (point: Point) => [right, up].map((row) => row.reduce((sum, part, axis) => sum + part * point[axis], 0));
  const all = [low, high].flatMap(([x]) =>
    [low, high].flatMap(([, y]) => [low, high].map(([, , z]) => flat([x, y, z]))),
  );
  const boxCorners = boxes.flatMap((box) => FACES[view].flatMap((face) => corners(box.low, box.high, face).map(flat)));
  const { left, right: far, top: least, bottom: most } = boundsOf([...all, ...boxCorners]);
  const scale = Math.min((room - 2) / (far - left), (HIGHEST[view] - 2) / (most - least));
  const width = Math.round(scale * (far - left)) + 2;
  const height = scale * (most - least) + 2;
  const place = (points: readonly Point[]) =>
    points.map(flat).map(([x, y]) => [(x - left) * scale + 1, height - ((y - least) * scale + 1)]);
  const side = (face: Face, attributes: Record<string, string | number>, [from, to] = inside) =>
    polygon(place(corners(from, to, face)), attributes);

  const parts: SVGElement[] = [];
  const over: SVGElement[] = [];
  if (closed) {
    for (const [axis, isFar] of FACES[view])
      parts.push(side([axis, !isFar], { fill: "none", stroke: FRAME, "stroke-width": 1 }));
  } else {
    if (margin > 0) parts.push(side([2, false], { fill: GROUND, stroke: "none" }, [low, [high[0], high[1], 0]]));
    if (bed > 0 && view !== "top")
      for (const face of FACES[view].filter(([axis]) => axis !== 2))
        parts.push(
          side(face, { fill: shaded(BED, SHADES[face[0]]), stroke: LINE, "stroke-width": 0.6 }, [
            [0, 0, -bed],
            [size[0], size[1], 0],
          ]),
        );
    const dashed = { fill: "#ffffff", stroke: LINE, "stroke-width": 0.6, "stroke-dasharray": "4 3" };
    parts.push(side([2, false], dashed));
    if (openings.roof && view === "side")
      parts.push(side([2, true], { fill: "none", stroke: FRAME, "stroke-width": 1 }));
    for (const [index, { axis, far: isFar }] of UPRIGHT.entries()) {
      const wall = openings.walls[index];
      const full = isFull(openings, index, size[2]);
      const near = FACES[view].some(([of, to]) => of === axis && to === isFar);
      if (wall === 0 || (near && full)) continue;
      const line = { fill: "none", stroke: full ? FRAME : LINE, "stroke-width": 1 };
      (near ? over : parts).push(side([axis, isFar], line, [inside[0], [size[0], size[1], wall]]));
    }
  }
  const order = backToFront(boxes, view);
  const drawn = order.map((i) => FACES[view].map((face) => place(corners(boxes[i].low, boxes[i].high, face))));
  const bounds = drawn.map((faces) => boundsOf(faces.flat()));
  for (const [at, i] of order.entries()) {
    const box = boxes[i];
    for (const [j, [axis]] of FACES[view].entries()) {
      const fill = shaded(FILLS[box.state], SHADES[axis]);
      parts.push(polygon(drawn[at][j], { fill, stroke: LINE, "stroke-width": 0.6, "stroke-linejoin": "round" }));
    }
    if (view === "corner") {
      if (box.state === "first") parts.push(label(String(box.number), boundsOf(drawn[at][1])));
      continue;
    }
    // A label that another box would cut in two is left out.
    const own = bounds[at];
    const text = fittingLabel(box, own.right - own.left, own.bottom - own.top);
    const half = (LETTER_WIDTH * LETTER * text.length) / 2;
    const [x, y] = [(own.left + own.right) / 2, (own.top + own.bottom) / 2];
    const place = { left: x - half, right: x + half, top: y - LETTER / 2, bottom: y + LETTER / 2 };
    if (text !== "" && !bounds.slice(at + 1).some((later) => meet(later, place))) parts.push(label(text, own));
  }
  const box = { viewBox: `0 0 ${width} ${Math.round(height)}`, width, height: Math.round(height) };
  return svg("svg", { ...box, role: "img", "aria-label": VIEW_NAMES[view] }, ...parts, ...over);
}

/** From where each view looks. */
export const VIEW_NAMES: Record<View, string> = {
  top: "from above; the front wall is on the left",
  side: "from the left side",
  corner: "from above the door",
};
