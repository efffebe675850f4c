import type { Segment, World } from "../data/results";

type Vector = [number, number, number];

/** m/s²: the container's acceleration at a time, as the run was given it. */
export function accelerationAt(segments: readonly Segment[], time: number): Vector {
  const sum: Vector = [0, 0, 0];
  for (const { start, duration, value } of segments)
    if (time >= start && time < start + duration) for (let axis = 0; axis < 3; ++axis) sum[axis] += value[axis];
  return sum;
}

/** The same of a world, which is not accelerated where it ended while it settled. */
export const accelerationOf = ({ accelerated, segments }: World, time: number): Vector =>
  accelerated ? accelerationAt(segments, time) : [0, 0, 0];

/** The same as steps: each time at which it changes, and its value from there. */
export function accelerationSteps(world: World, begin: number, end: number): { time: number; value: Vector }[] {
  const breaks = new Set([begin]);
  for (const { start, duration } of world.segments)
    for (const time of [start, start + duration]) if (time > begin && time < end) breaks.add(time);
  return [...breaks].sort((a, b) => a - b).map((time) => ({ time, value: accelerationOf(world, time + 1e-9) }));
}
