import { UPRIGHT } from "./openings";
import type { Segment } from "./results";

/** m/s²: what norms and margins call 1 g. */
export const GRAVITY = 9.81;

/** g: what pushes less pushes nothing. */
const LEAST = 0.005;
/** A component of a push that is smaller than this share of the largest one is left out of its direction. */
const ASIDE = 0.1;
/** Pushes that a sentence tells one by one. */
const MOST_TOLD = 3;

/** How hard a container's acceleration (m/s²) pushes the load towards each side of `UPRIGHT`, g: it pushes against where it goes. */
export const pushesOf = (acceleration: ArrayLike<number>): number[] =>
  UPRIGHT.map(({ axis, far }) => Math.max(0, (far ? -1 : 1) * acceleration[axis]) / GRAVITY);

/** The sides to which an acceleration of the container (m/s²) pushes the load: "front", or "front and left"; empty: none. */
export function pushedTo(acceleration: ArrayLike<number>): string {
  const size = Math.hypot(acceleration[0], acceleration[1]) / GRAVITY;
  if (size < LEAST) return "";
  const sides = pushesOf(acceleration);
  return UPRIGHT.filter((_, side) => sides[side] > ASIDE * size)
    .map(({ name }) => name)
    .join(" and ");
}

/** A push in one direction. */
export interface Push {
  /** "front", or "front and left" */
  to: string;
  /** g, at its largest */
  size: number;
  /** what the load weighs meanwhile, as a share of its weight; at its largest push */
  weight: number;
  /** s */
  begin: number;
  end: number;
}

/** Where an acceleration pushes the load, in the order of time: what goes on in the same direction is one push. */
export function pushesOver(segments: readonly Segment[]): Push[] {
  const pushes: Push[] = [];
  for (const { start, duration, value } of segments) {
    const to = pushedTo(value);
    if (to === "") continue;
    const size = Math.hypot(value[0], value[1]) / GRAVITY;
    const weight = 1 + value[2] / GRAVITY;
    const last = pushes[pushes.length - 1];
    if (last?.to === to && Math.abs(last.end - start) < 1e-6) {
      last.end = start + duration;
      if (size > last.size) Object.assign(last, { size, weight });
    } else pushes.push({ to, size, weight, begin: start, end: start + duration });
  }
  return pushes;
}

const number = (value: number) => String(Number(value.toPrecision(3)));

/** Where an acceleration pushes the load hardest, and how hard: "front 0.8 g"; empty: nowhere. */
export function pushText(segments: readonly Segment[]): string {
  const pushes = pushesOver(segments);
  if (pushes.length === 0) return "";
  const { to, size } = hardest(pushes);
  return `${to} ${number(size)} g`;
}

const hardest = (pushes: readonly Push[]) => pushes.reduce((most, push) => (push.size > most.size ? push : most));

/** What an acceleration does to the load, in a planner's words. */
export function pushSentence(segments: readonly Segment[]): string {
  const pushes = pushesOver(segments);
  if (pushes.length === 0) return "The load is not pushed to any side.";
  const largest = hardest(pushes);
  const light =
    Math.abs(largest.weight - 1) > LEAST
      ? ` Meanwhile it weighs ${number(100 * largest.weight)} % of what it weighs at rest.`
      : "";
  if (pushes.length > MOST_TOLD)
    return `The load is pushed ${pushes.length} times, hardest to the ${largest.to} with ${number(largest.size)} g.${light}`;
  const told = pushes.map(
    ({ to, size, begin, end }) => `to the ${to} with ${number(size)} g, from ${number(begin)} s to ${number(end)} s`,
  );
  return `The load is pushed ${told.join(", then ")}.${light}`;
}
