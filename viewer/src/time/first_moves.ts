import type { Thresholds, World } from "../data/results";

/**
 * A box counts as moving from the first sample in which it is displaced, sunk or turned by more than this share of the limits of
 * the verdict: 1 cm and 1° with the usual ones. A smaller share shows boxes that only give way to their neighbours, a greater one
 * misses which of two boxes began.
 */
export const MOVING = 0.1;

/** Angle between an orientation and that at t = 0, degree. */
export function tiltOf(orientation: Float32Array, start: number, at: number): number {
  let cosine = 0;
  for (let i = 0; i < 4; ++i) cosine += orientation[start + i] * orientation[at + i];
  return (2 * Math.acos(Math.min(1, Math.abs(cosine))) * 180) / Math.PI;
}

/** First sample in which each box moves; -1: it does not, or the file has no series. */
export function firstMoves(world: World, limits: Thresholds): Int32Array {
  const boxes = world.boxes.id.length;
  const first = new Int32Array(boxes).fill(-1);
  const { series } = world;
  if (!series) return first;
  const { displacement, orientation } = series;
  // Half the angle's cosine, so that no arc cosine is needed for each row.
  const leastCosine = Math.cos((MOVING * limits.tilt * Math.PI) / 360);
  for (let box = 0; box < boxes; ++box) {
    for (let sample = 0; sample < series.time.length; ++sample) {
      const at = 3 * (sample * boxes + box);
      const length = Math.hypot(displacement[at], displacement[at + 1], displacement[at + 2]);
      const q = 4 * (sample * boxes + box);
      let cosine = 0;
      for (let i = 0; i < 4; ++i) cosine += orientation[4 * box + i] * orientation[q + i];
      if (
        length > MOVING * limits.move ||
        -displacement[at + 2] > MOVING * limits.drop ||
        Math.abs(cosine) < leastCosine
      ) {
        first[box] = sample;
        break;
      }
    }
  }
  return first;
}

/** Boxes that move, those that move first before the others; of the same sample, those that are farther then. */
export function orderOfMoves(world: World, first: Int32Array): number[] {
  const boxes = world.boxes.id.length;
  const series = world.series;
  if (!series) return [];
  const far = (box: number) => {
    const at = 3 * (first[box] * boxes + box);
    return Math.hypot(series.displacement[at], series.displacement[at + 1], series.displacement[at + 2]);
  };
  return [...first.keys()]
    .filter((box) => first[box] >= 0)
    .sort((a, b) => first[a] - first[b] || far(b) - far(a) || a - b);
}
