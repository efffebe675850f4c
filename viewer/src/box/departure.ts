import { isFull, type Openings, sideName, UPRIGHT } from "../data/openings";
import type { Results, World } from "../data/results";
import { tiltOf } from "../time/poses";
import { seconds } from "../ui/text";

/** How a box left the container. */
export interface Departure {
  /** of `UPRIGHT`, or the roof after them */
  side: number;
  /** "through the open rear", "over the low left side" */
  way: string;
  /** s, of the first sample outside, or fallen where it was outside as loaded; NaN where the file has no series */
  time: number;
  /** its tilt was beyond the limit when it was outside first */
  tipped: boolean;
  /** it ends lower than the floor */
  fell: boolean;
}

/**
 * The side that a point is beyond: an open or low one, the farthest of several; the open roof where all that it is beyond are full
 * walls; -1 where it is within, or where no way leads out.
 */
export function sideBeyond(container: readonly number[], openings: Openings, point: ArrayLike<number>): number {
  let found = -1;
  let farthest = 0;
  let outside = false;
  for (const [side, { axis, far }] of UPRIGHT.entries()) {
    const beyond = far ? point[axis] - container[axis] : -point[axis];
    outside ||= beyond > 0;
    if (beyond <= farthest || isFull(openings, side, container[2])) continue;
    farthest = beyond;
    found = side;
  }
  return found < 0 && outside && !openings.roof ? UPRIGHT.length : found;
}

/** Where the centre of mass of a box is; the displacement begins at an index of a table. */
const centreOf = ({ boxes }: World, box: number, displacement: Float32Array, at: number) =>
  [0, 1, 2].map((axis) => boxes.reference[3 * box + axis] + displacement[at + axis]);

/** Whether the centre of mass of a box was outside as loaded. */
const startsOutside = ({ boxes, container }: World, box: number) =>
  sideBeyond(container.size, container.openings, boxes.reference.subarray(3 * box, 3 * box + 3)) >= 0;

/** The side beyond which a box that left is at the end: it was within as loaded, or has fallen since; -1: it has not left. */
export function sideLeft({ thresholds }: Results, world: World, box: number): number {
  const { boxes, container } = world;
  const fell = boxes.end.drop[box] > thresholds.drop;
  const end = centreOf(world, box, boxes.endDisplacement, 3 * box);
  return fell || !startsOutside(world, box) ? sideBeyond(container.size, container.openings, end) : -1;
}

/** How a box left; null: it did not. */
export function departureOf(results: Results, world: World, box: number): Departure | null {
  const { thresholds } = results;
  const { boxes, series } = world;
  const { size: container, openings } = world.container;
  const end = centreOf(world, box, boxes.endDisplacement, 3 * box);
  const outside = startsOutside(world, box);
  let side = sideLeft(results, world, box);
  if (side < 0) return null;
  let time = Number.NaN;
  let tilt = boxes.end.tilt[box];
  const count = boxes.id.length;
  for (let sample = 0; series && sample < series.time.length; ++sample) {
    const at = sample * count + box;
    const beyond = sideBeyond(container, openings, centreOf(world, box, series.displacement, 3 * at));
    const fell = -series.displacement[3 * at + 2] > thresholds.drop;
    if (beyond < 0 || (outside && !fell)) continue;
    side = beyond;
    time = series.time[sample];
    tilt = tiltOf(series.orientation, 4 * box, 4 * at);
    break;
  }
  const low = openings.walls[side] > 0;
  const way = low ? `over the low ${sideName(side)}` : `through the open ${sideName(side)}`;
  return { side, way, time, tipped: tilt > thresholds.tilt, fell: end[2] < 0 };
}

/** The same as sentences: none or one. */
export function departureSentences(results: Results, world: World, box: number): string[] {
  const departure = departureOf(results, world, box);
  if (!departure) return [];
  const { way, time, tipped, fell } = departure;
  const verb = way.startsWith("through") ? "left" : tipped ? "tipped" : "went";
  const when = Number.isNaN(time) ? "" : time < 0 ? " while the load settled" : ` by ${seconds(time)}`;
  return [
    `It ${verb} ${way}${when}${fell && world.container.openings.bedHeight > 0 ? ", and fell to the ground" : ""}.`,
  ];
}

/** How many boxes left which way, as a sentence; null: none. */
export function departuresSentence(results: Results, world: World): string | null {
  const ways = new Map<string, number>();
  for (const box of world.boxes.id.keys()) {
    const way = departureOf(results, world, box)?.way;
    if (way) ways.set(way, (ways.get(way) ?? 0) + 1);
  }
  const list = [...ways].map(([way, number]) => `${number} ${way}`);
  return list.length > 0 ? `Left the container: ${list.join(", ")}.` : null;
}
