import { VERDICT_CODES } from "../data/outcome";
import { GRAVITY } from "../data/push";
import type { BoxColumns, BoxDamage, Damage, World } from "../data/results";
import { between, tiltOf, times } from "../time/poses";

/** Verdict of a box, as a code of verdicts. */
export function boxVerdict({ unstable, fallen, moved, tilted }: BoxColumns, box: number): number {
  if (unstable[box]) return VERDICT_CODES.unstable;
  if (fallen[box]) return VERDICT_CODES.fell;
  return moved[box] || tilted[box] ? VERDICT_CODES.moved : VERDICT_CODES.stayed;
}

/** m/s, mean between the two samples around the time. */
export function speedsAt(world: World, time: number, out: Float32Array): void {
  const count = world.boxes.id.length;
  const series = world.series;
  if (!series || series.time.length < 2) {
    out.fill(0);
    return;
  }
  const sample = Math.min(between(times(world), time).sample, series.time.length - 2);
  const step = series.time[sample + 1] - series.time[sample];
  for (let box = 0; box < count; ++box) {
    const a = 3 * (sample * count + box);
    const b = a + 3 * count;
    const d = series.displacement;
    out[box] = step > 0 ? Math.hypot(d[b] - d[a], d[b + 1] - d[a + 1], d[b + 2] - d[a + 2]) / step : 0;
  }
}

/** Degree, at the sample before the time. */
export function tiltsAt(world: World, time: number, out: Float32Array): void {
  const count = world.boxes.id.length;
  const { series, boxes } = world;
  const { sample, share } = between(times(world), time);
  for (let box = 0; box < count; ++box)
    out[box] = series
      ? tiltOf(series.orientation, 4 * box, 4 * (sample * count + box))
      : (sample === 1 ? 1 : share) * boxes.end.tilt[box];
}

/** How near each box came to the damage boundary: 1 is there, and both of its numbers have to be exceeded. */
export const damageIndices = (
  { acceleration, velocityChange }: BoxDamage,
  boundary: Damage["boundary"],
): Float32Array =>
  acceleration.map((size, box) =>
    Math.min(size / GRAVITY / boundary.acceleration, velocityChange[box] / boundary.velocityChange),
  );
