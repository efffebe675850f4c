import { isClosed, isFull, type Openings, UPRIGHT } from "../data/openings";
import { Rectangles } from "./rectangles";

/** m: walls are so thick, outwards. */
const THICKNESS = 0.05;

/** m: length, width, height */
export type Size = readonly [number, number, number];

/** Floor, walls up to their heights with the tops of low ones, and roof. */
export function insideOf(size: Size, openings: Openings): Rectangles {
  const all = new Rectangles();
  const [length, width, height] = size;
  all.add([0, 0, 0], [length, width, 0], 1);
  if (openings.roof) all.add([0, 0, height], [length, width, height], -1);
  const low = openings.walls.map((wall, side) => wall > 0 && !isFull(openings, side, height));
  for (const [side, { axis, far }] of UPRIGHT.entries()) {
    const top = openings.walls[side];
    if (top === 0) continue;
    const at = far ? size[axis] : 0;
    const from = [0, 0, 0];
    const to = [length, width, top];
    from[axis] = to[axis] = at;
    all.add(from, to, far ? -1 : 1);
    if (!low[side]) continue;
    // Its top: low neighbours meet in the corner.
    const outer = outline(size, low);
    const [edge, end] = [from.slice(), to.slice()];
    edge[2] = end[2] = top;
    edge[1 - axis] = outer.low[1 - axis];
    end[1 - axis] = outer.high[1 - axis];
    if (far) end[axis] = outer.high[axis];
    else edge[axis] = outer.low[axis];
    all.add(edge, end, 1);
  }
  return all;
}

/** The sides of the block that floor and walls stand on; none where the container is closed, or its floor has no end. */
export function bedOf(size: Size, openings: Openings): Rectangles {
  const all = new Rectangles();
  if (openings.bedHeight === 0 || isClosed(openings, size[2])) return all;
  const walled = openings.walls.map((wall) => wall > 0);
  const { low, high } = outline(size, walled);
  for (const { axis, far } of UPRIGHT) {
    const from = [...low, -openings.bedHeight];
    const to = [...high, 0];
    from[axis] = to[axis] = far ? high[axis] : low[axis];
    all.add(from, to, far ? 1 : -1);
  }
  return all;
}

/** Of the container with the walls of some sides, from above. */
function outline([length, width]: Size, walls: readonly boolean[]): { low: number[]; high: number[] } {
  const [front, rear, left, right] = walls.map((wall) => (wall ? THICKNESS : 0));
  return { low: [0 - front, 0 - left], high: [length + rear, width + right] };
}
