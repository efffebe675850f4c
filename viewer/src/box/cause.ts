import { excursionsTo, shareOfLimits } from "../data/excursions";
import { betweenBoxes, onFloor } from "../data/friction";
import { REAR, sideName, UPRIGHT } from "../data/openings";
import { GRAVITY } from "../data/push";
import type { BoxColumns, Results, Series, Thresholds, World } from "../data/results";
import { tiltOf } from "../time/poses";
import { compared, gravities, metres } from "../ui/text";

/**
 * A box begins to move in the first sample in which it has used up more than this share of a limit: 1 cm or 1° with the usual ones.
 * A smaller share takes boxes that only give way to their neighbours, a greater one is too late to see what began.
 */
const MOVING = 0.1;
/** Friction that is as near as this, relative to the push, may hold it or not: as in the program's caveat. */
const MARGINAL = 0.02;
/** m: boxes closer than this touch, as loaded. */
const TOUCH = 0.005;

const middle = (boxes: BoxColumns, box: number, axis: number) =>
  boxes.reference[3 * box + axis] - boxes.centre[3 * box + axis];
const low = (boxes: BoxColumns, box: number, axis: number) => middle(boxes, box, axis) - boxes.size[3 * box + axis] / 2;
const high = (boxes: BoxColumns, box: number, axis: number) =>
  middle(boxes, box, axis) + boxes.size[3 * box + axis] / 2;
const overlap = (boxes: BoxColumns, a: number, b: number, axis: number) =>
  Math.min(high(boxes, a, axis), high(boxes, b, axis)) - Math.max(low(boxes, a, axis), low(boxes, b, axis));

/** m that the box can go along an axis, as loaded, until another box or the end of the container is in its way. */
export function freeWay(
  boxes: BoxColumns,
  container: readonly number[],
  box: number,
  axis: number,
  up: boolean,
): number {
  let free = up ? container[axis] - high(boxes, box, axis) : low(boxes, box, axis);
  const others = [0, 1, 2].filter((other) => other !== axis);
  for (let next = 0; next < boxes.id.length; ++next) {
    if (next === box || others.some((other) => overlap(boxes, box, next, other) <= TOUCH)) continue;
    const gap = up ? low(boxes, next, axis) - high(boxes, box, axis) : low(boxes, box, axis) - high(boxes, next, axis);
    if (gap > -TOUCH) free = Math.min(free, Math.max(0, gap));
  }
  return Math.max(0, free);
}

const standsOnFloor = (boxes: BoxColumns, box: number) => low(boxes, box, 2) < TOUCH;

/** The boxes that a box stands on, as loaded, and the areas, m². */
function boxesBelow(boxes: BoxColumns, box: number): { below: number; area: number }[] {
  const found: { below: number; area: number }[] = [];
  for (let below = 0; below < boxes.id.length; ++below) {
    if (below === box || Math.abs(low(boxes, box, 2) - high(boxes, below, 2)) > TOUCH) continue;
    const x = overlap(boxes, box, below, 0);
    const y = overlap(boxes, box, below, 1);
    if (x > 0 && y > 0) found.push({ below, area: x * y });
  }
  return found;
}

/** Share of the box's base that lies on the floor or on boxes, as loaded. */
export function supported(boxes: BoxColumns, box: number): number {
  if (standsOnFloor(boxes, box)) return 1;
  const area = boxesBelow(boxes, box).reduce((sum, one) => sum + one.area, 0);
  return Math.min(1, area / (boxes.size[3 * box] * boxes.size[3 * box + 1]));
}

/**
 * The coefficient of friction of a box and what it stands on, as loaded: that of its mat, else of its pair. NaN where the settings do
 * not say it, or say different ones of the boxes below.
 */
export function frictionBelow(settings: Results["settings"], boxes: BoxColumns, box: number): number {
  const { material, mat } = boxes;
  if (Number.isFinite(mat[box])) return mat[box];
  if (standsOnFloor(boxes, box)) return onFloor(settings, material[box]);
  const all = new Set(
    boxesBelow(boxes, box).map(({ below }) => betweenBoxes(settings, material[box], material[below])),
  );
  return all.size === 1 ? [...all][0] : Number.NaN;
}

/** Whether friction holds a push (g), as a sentence; null: it holds, or its coefficient is not known. */
export function frictionSentence(push: number, friction: number): string | null {
  if (Math.abs(push - friction) <= MARGINAL * push)
    return `The push of ${gravities(push)} is what friction just holds, or just does not.`;
  if (!(push > friction)) return null;
  const [more, less] = compared(push, friction, gravities);
  return `The push of ${more} is more than friction holds (${less}).`;
}

/** The first sample in which a box moves; -1: it does not. */
export function beginOfMotion(series: Series, boxes: number, box: number, limits: Thresholds): number {
  for (let sample = 0; sample < series.time.length; ++sample) {
    const at = sample * boxes + box;
    const tilt = Float32Array.of(tiltOf(series.orientation, 4 * box, 4 * at));
    const now = excursionsTo(series.displacement.subarray(3 * at, 3 * at + 3), tilt);
    if (shareOfLimits(now, 0, limits) > MOVING) return sample;
  }
  return -1;
}

/** What a box does when it begins to move, and what in the layout lets it. */
export function causeOf(results: Results, world: World, box: number): string[] {
  const { boxes, series } = world;
  if (!series) return [];
  const count = boxes.id.length;
  const sample = beginOfMotion(series, count, box, results.thresholds);
  if (sample < 0) return [];
  const at = 3 * (sample * count + box);
  const [x, y, z] = series.displacement.subarray(at, at + 3);
  const axis = Math.abs(x) >= Math.abs(y) ? 0 : 1;
  const up = (axis === 0 ? x : y) > 0;
  const way = Math.abs(axis === 0 ? x : y);
  const tilt = tiltOf(series.orientation, 4 * box, 4 * (sample * count + box));
  // Turning by the tilt moves an edge so far; what is more than sliding tips.
  const turned = ((tilt * Math.PI) / 180) * boxes.size[3 * box + 2];
  const side = UPRIGHT.findIndex((of) => of.axis === axis && of.far === up);
  const { size: container, openings } = world.container;
  const wall = openings.walls[side];
  const full = wall >= container[2];
  const sinks = -z > way && -z > turned / 2;
  const tips = !sinks && turned > way;
  const sentences = [
    sinks
      ? "It sinks."
      : `It ${tips ? "tips" : "slides"} towards the ${side === REAR && full ? "door" : UPRIGHT[side].name}.`,
  ];

  const push = Math.max(
    ...[sample, sample - 1]
      .filter((i) => i >= 0)
      .map((i) => Math.hypot(series.acceleration[3 * i], series.acceleration[3 * i + 1]) / GRAVITY),
  );
  const share = supported(boxes, box);
  if (share < 0.995) sentences.push(`${(100 * share).toFixed(0)} % of its base is supported.`);
  if (push > 0.005) {
    const friction = frictionBelow(results.settings, boxes, box);
    const slides = frictionSentence(push, friction);
    if (slides) sentences.push(slides);
    else if (friction > push && tips)
      sentences.push(
        `The push is ${gravities(push)}, and the box is ${slenderness(boxes, box, axis)} times as high as it is deep in that direction.`,
      );
  }
  if (!sinks) {
    const free = freeWay(boxes, container, box, axis, up);
    const toEnd = up ? container[axis] - high(boxes, box, axis) : low(boxes, box, axis);
    if (!full && free >= toEnd) sentences.push(endSentence(free, side, wall, low(boxes, box, 2)));
    else
      sentences.push(
        free < TOUCH
          ? `What stands next to it on that side goes with it, or is lower.`
          : `It has ${metres(free)} of free space there.`,
      );
  }
  return sentences;
}

/** What is on the way of a box to a side that is open or low, from so far and so high above the floor. */
function endSentence(free: number, side: number, wall: number, bottom: number): string {
  const space = free < TOUCH ? "It stands" : `It has ${metres(free)} of free space there, up`;
  const what = wall > 0 ? `the ${sideName(side)}, which is only ${metres(wall)} high` : `the open ${sideName(side)}`;
  const above = wall > 0 && bottom > wall - TOUCH ? ": it stands above that" : "";
  return `${space}${free < TOUCH ? " at" : " to"} ${what}${above}.`;
}

const slenderness = (boxes: BoxColumns, box: number, axis: number) =>
  (boxes.size[3 * box + 2] / boxes.size[3 * box + axis]).toFixed(1);
