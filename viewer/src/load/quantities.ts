import { VERDICT_CODES } from "../data/outcome";
import type { Results, World } from "../data/results";
import { firstMoves, orderOfMoves, tiltOf } from "../time/first_moves";
import { between, times } from "../time/poses";

/** What is computed from a world once, when it is opened. */
export interface Derived {
  /** verdict of each box at the end, as codes of verdicts */
  verdict: Uint8Array;
  firstMove: Int32Array;
  moveOrder: number[];
  /** m, length of the displacement at the end */
  endDistance: Float32Array;
}

export function derive(results: Results, world: World): Derived {
  const { boxes } = world;
  const { move, drop, tilt } = results.thresholds;
  const count = boxes.id.length;
  const verdict = new Uint8Array(count);
  const endDistance = new Float32Array(count);
  for (let box = 0; box < count; ++box) {
    endDistance[box] = Math.hypot(...boxes.endDisplacement.subarray(3 * box, 3 * box + 3));
    const settling = boxes.settling.subarray(3 * box, 3 * box + 3);
    if (boxes.fallen[box]) verdict[box] = VERDICT_CODES.fell;
    else if (Math.hypot(...settling) > move || -settling[2] > drop) verdict[box] = VERDICT_CODES.unstable;
    else if (boxes.moved[box] || boxes.endTilt[box] > tilt) verdict[box] = VERDICT_CODES.moved;
  }
  const firstMove = firstMoves(world, results.thresholds);
  return { verdict, firstMove, moveOrder: orderOfMoves(world, firstMove), endDistance };
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
      : (sample === 1 ? 1 : share) * boxes.endTilt[box];
}
