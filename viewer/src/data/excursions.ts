import type { Excursions, Thresholds } from "./results";

/** The largest share of a limit that a box has used up; it is beyond one where this is more than 1. */
export function shareOfLimits(of: Excursions, box: number, limits: Thresholds): number {
  const share = (size: number, limit: number) => (size > 0 ? size / limit : 0);
  return Math.max(
    share(of.displacement[box], limits.move),
    share(of.drop[box], limits.drop),
    share(of.tilt[box], limits.tilt),
  );
}

export const isBeyond = (of: Excursions, box: number, limits: Thresholds) =>
  of.displacement[box] > limits.move || of.drop[box] > limits.drop || of.tilt[box] > limits.tilt;

/** The least share of a limit that is told: boxes that use up less stand as well as still. As in the program. */
const NOTABLE_SHARE = 0.01;

/**
 * The box that was beyond a limit first, in the order of the layout where several were at a time; where none was, or times are not
 * known, the one that used up most of a limit. Counted from 1; 0 where none has used up a notable share. As the program finds it:
 * for files that do not have it, and worlds that run in this page.
 */
export function criticalBox(firstBeyond: Float32Array, of: Excursions, limits: Thresholds): number {
  let first = 0;
  let farthest = 0;
  let earliest = Number.POSITIVE_INFINITY;
  let most = NOTABLE_SHARE;
  for (let box = 0; box < firstBeyond.length; ++box) {
    // False where it is NaN.
    if (firstBeyond[box] < earliest) {
      earliest = firstBeyond[box];
      first = box + 1;
    }
    const share = shareOfLimits(of, box, limits);
    if (share > most) {
      most = share;
      farthest = box + 1;
    }
  }
  return first > 0 ? first : farthest;
}

/** Columns of so many boxes. */
export const noExcursions = (boxes: number): Excursions => ({
  displacement: new Float32Array(boxes),
  drop: new Float32Array(boxes),
  tilt: new Float32Array(boxes),
});

/** How far boxes are from their reference poses: displacements as tables of three (m), and angles (degree). */
export function excursionsTo(displacement: Float32Array, tilt: Float32Array): Excursions {
  const { displacement: length, drop } = noExcursions(tilt.length);
  for (let box = 0; box < tilt.length; ++box) {
    const [x, y, z] = displacement.subarray(3 * box, 3 * box + 3);
    length[box] = Math.hypot(x, y, z);
    drop[box] = Math.max(0, -z);
  }
  return { displacement: length, drop, tilt };
}
