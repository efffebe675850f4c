import { isClosed, isFull, type Openings, UPRIGHT } from "../data/openings";
import type { Container } from "../data/results";
import { fittingLabel, LETTER, LINE_HEIGHT, sizeOfLabel } from "./box_label";
import {
  type Bounds,
  corners,
  FACES,
  type Face,
  middleOf,
  type PaintedBox,
  type Point,
  SHADES,
  type View,
} from "./faces";

/** Draws a load for print, as `holdfast report` does (tools/load_views.py): with its colours, views and labels. */

export const FILLS = { still: "#e9edf2", later: "#f3c58b", first: "#d9534f", fixed: "#949da8" } as const;
export type State = keyof typeof FILLS;

const LINE = "#5a6470";
const FRAME = "#222831";
const BRIGHT = "#ffffff";
const BED = "#dfe2e6";
const GROUND = "#f3f4f6";
/** m around the container that the ground is drawn for */
const GROUND_MARGIN = 0.5;
/** Pixels. */
const PAGE_WIDTH = 684;
/** Pixels between two pictures. */
const GAP = 12;
/** Pixels: a page has room for pictures that are so high, of the load from above and from the side together, and of its corner. */
export const HIGHEST = 250;
const HIGHEST_CORNER = 130;

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
  rear: [
    [0, 1, 0],
    [0, 0, 1],
  ],
  front: [
    [0, -1, 0],
    [0, 0, 1],
  ],
  // From above the door, on the left.
  corner: [
    [0.87, 0.5, 0],
    [-0.3, 0.4, 0.85],
  ],
};

/** From where each view looks. */
export const VIEW_NAMES: Record<View, string> = {
  top: "from above; the front wall is on the left",
  side: "from the left side",
  rear: "from the rear",
  front: "from the front",
  corner: "from above the door",
};

/** What is drawn of a box beside its faces. */
export interface DrawnBox {
  state: State;
  number: number;
  /** empty: it has none */
  name: string;
}

/** Pixels: width and height. */
export type Room = readonly [width: number, height: number];

const bedOf = (openings: Openings, height: number) => (isClosed(openings, height) ? 0 : openings.bedHeight);

/** The room of each view. Those that look along an axis have one scale, and three of them fit beside each other. */
export function roomsOfViews({ size, openings }: Container): Record<View, Room> {
  const [length, width] = size;
  const height = size[2] + bedOf(openings, size[2]);
  const scale = Math.min((PAGE_WIDTH - 2 * GAP - 6) / (length + 2 * width), HIGHEST / (width + height));
  const room = (across: number, up: number): Room => [scale * across + 2, scale * up + 2];
  const top = room(length, width);
  return {
    top,
    side: room(length, height),
    rear: room(width, height),
    front: room(width, height),
    corner: [PAGE_WIDTH - GAP - top[0], Math.max(HIGHEST_CORNER, top[1])],
  };
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

function shaded(colour: string, shade: number): string {
  const parts = [1, 3, 5].map((i) => Math.round(shade * Number.parseInt(colour.slice(i, i + 2), 16)));
  return `#${parts.map((part) => part.toString(16).padStart(2, "0")).join("")}`;
}

const pointsText = (points: readonly Point[]) => points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`);

const polygon = (points: readonly Point[], attributes: Record<string, string | number>) =>
  svg("polygon", { points: pointsText(points).join(" "), ...attributes });

/** A face of a box. Signs beside the colours tell those that go first, and what is fixed, on paper without colours. */
function painted(points: readonly Point[], state: State, shade: number): SVGElement[] {
  const line = state === "first" ? { stroke: FRAME, "stroke-width": 1.8 } : { stroke: LINE, "stroke-width": 0.6 };
  const face = polygon(points, { fill: shaded(FILLS[state], shade), "stroke-linejoin": "round", ...line });
  if (state !== "fixed") return [face];
  const [a, b, c, d] = pointsText(points);
  return [face, svg("path", { d: `M${a} L${c} M${b} L${d}`, stroke: LINE, "stroke-width": 0.6 })];
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

const middle = ({ left, right, top, bottom }: Rectangle): [number, number] => [(left + right) / 2, (top + bottom) / 2];

/** A label in the middle of a face. */
function label(lines: readonly string[], state: State, bounds: Rectangle): SVGElement[] {
  const [x, y] = middle(bounds);
  const first = y - ((lines.length - 1) / 2) * LINE_HEIGHT * LETTER + 0.35 * LETTER;
  return lines.map((line, i) => {
    const place = { x: x.toFixed(1), y: (first + i * LINE_HEIGHT * LETTER).toFixed(1) };
    const fill = state === "first" ? BRIGHT : FRAME;
    return svg("text", { ...place, "font-size": LETTER, "text-anchor": "middle", fill }, line);
  });
}

/** Whether a box lies beside the container where a view does not look: the floor can hide it. */
function isBeyondHiddenSide(box: PaintedBox, size: readonly number[], view: View): boolean {
  const centre = middleOf(box);
  return FACES[view].some(([axis, far]) => axis !== 2 && (far ? centre[axis] < 0 : centre[axis] > size[axis]));
}

/**
 * Boxes in a container, with those that lie beside it.
 * @param faces of the boxes, in the order in which they are painted
 * @param room that the picture may take
 * @param labelled boxes have their names or numbers in views along an axis; else those that go first have their numbers
 */
export function draw(
  faces: readonly PaintedBox[],
  boxes: readonly DrawnBox[],
  { size, openings }: Container,
  view: View,
  room: Room,
  labelled: boolean,
): SVGElement {
  const [right, up] = PROJECTIONS[view];
  const closed = isClosed(openings, size[2]);
  const bed = bedOf(openings, size[2]);
  const margin = bed > 0 && view === "corner" ? GROUND_MARGIN : 0;
  const inside: Bounds = { low: [0, 0, 0], high: size };
  const shown = { low: [-margin, -margin, -bed], high: [size[0] + margin, size[1] + margin, size[2]] };
  const flat = (point: Point) => [right, up].map((row) => row.reduce((sum, part, axis) => sum + part * point[axis], 0));
  const ends = [corners(shown, [2, false]), corners(shown, [2, true])].flat();
  const all = [...ends, ...faces.flatMap((of) => of.faces.flatMap((face) => face.corners))].map(flat);
  const { left, right: far, top: least, bottom: most } = boundsOf(all);
  const scale = Math.min((room[0] - 2) / (far - left), (room[1] - 2) / (most - least));
  const width = Math.round(scale * (far - left)) + 2;
  const height = scale * (most - least) + 2;
  const place = (points: readonly Point[]) =>
    points.map(flat).map(([x, y]) => [(x - left) * scale + 1, height - ((y - least) * scale + 1)]);
  const side = (face: Face, attributes: Record<string, string | number>, of = inside) =>
    polygon(place(corners(of, face)), attributes);

  const ground: SVGElement[] = [];
  const frame: SVGElement[] = [];
  const over: SVGElement[] = [];
  if (closed) {
    for (const [axis, isFar] of FACES[view])
      frame.push(side([axis, !isFar], { fill: "none", stroke: FRAME, "stroke-width": 1 }));
  } else {
    const block = { low: [0, 0, -bed], high: [size[0], size[1], 0] };
    if (margin > 0)
      ground.push(
        side([2, false], { fill: GROUND, stroke: "none" }, { low: shown.low, high: [shown.high[0], shown.high[1], 0] }),
      );
    if (bed > 0 && view !== "top")
      for (const face of FACES[view].filter(([axis]) => axis !== 2))
        frame.push(side(face, { fill: shaded(BED, SHADES[face[0]]), stroke: LINE, "stroke-width": 0.6 }, block));
    const dashed = { fill: "#ffffff", stroke: LINE, "stroke-width": 0.6, "stroke-dasharray": "4 3" };
    frame.push(side([2, false], dashed));
    if (openings.roof && view !== "top" && view !== "corner")
      frame.push(side([2, true], { fill: "none", stroke: FRAME, "stroke-width": 1 }));
    for (const [index, { axis, far: isFar }] of UPRIGHT.entries()) {
      const wall = openings.walls[index];
      const full = isFull(openings, index, size[2]);
      const near = FACES[view].some(([of, to]) => of === axis && to === isFar);
      if (wall === 0 || (near && full)) continue;
      const line = { fill: "none", stroke: full ? FRAME : LINE, "stroke-width": 1 };
      (near ? over : frame).push(side([axis, isFar], line, { low: inside.low, high: [size[0], size[1], wall] }));
    }
  }

  const behind: SVGElement[] = [];
  const before: SVGElement[] = [];
  const isLabelled = labelled && view !== "corner";
  const bounds = isLabelled ? faces.map((of) => boundsOf(place(of.faces[0].corners))) : [];
  for (const [at, of] of faces.entries()) {
    const box = boxes[of.box];
    const parts = isBeyondHiddenSide(of, size, view) ? behind : before;
    for (const face of of.faces) parts.push(...painted(place(face.corners), box.state, face.shade));
    if (isLabelled) {
      // A label that another box would cut in two is left out, and so is one that the sign of what is fixed would.
      const own = bounds[at];
      const lines = box.state === "fixed" ? [] : fittingLabel(box, own.right - own.left, own.bottom - own.top);
      const [x, y] = middle(own);
      const [across, high] = sizeOfLabel(lines);
      const taken = { left: x - across / 2, right: x + across / 2, top: y - high / 2, bottom: y + high / 2 };
      if (!bounds.slice(at + 1).some((later) => meet(later, taken))) parts.push(...label(lines, box.state, own));
    } else if (box.state === "first") {
      const face = of.faces[view === "corner" ? 1 : 0] ?? of.faces[0];
      parts.push(...label([String(box.number)], box.state, boundsOf(place(face.corners))));
    }
  }
  const box = { viewBox: `0 0 ${width} ${Math.round(height)}`, width, height: Math.round(height) };
  const parts = [...ground, ...behind, ...frame, ...before, ...over];
  return svg("svg", { ...box, role: "img", "aria-label": VIEW_NAMES[view] }, ...parts);
}
