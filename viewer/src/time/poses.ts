import type { World } from "../data/results";

/** A place between two samples: of the earlier one, and how far it is towards the later one, 0 to 1. */
export interface Between {
  sample: number;
  share: number;
}

/** Samples of a world, or begin and end where the file has no series. */
export function times(world: World): Float64Array {
  if (world.series) return world.series.time;
  const { beginTime, endTime } = world;
  return Float64Array.of(beginTime, Math.max(endTime || 0, beginTime + 1e-3));
}

export function between(time: Float64Array, at: number): Between {
  const last = time.length - 1;
  if (last <= 0 || at <= time[0]) return { sample: 0, share: 0 };
  if (at >= time[last]) return { sample: last, share: 0 };
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time[middle] <= at) low = middle;
    else high = middle;
  }
  return { sample: low, share: (at - time[low]) / (time[high] - time[low]) };
}

/** Displacements (m) and rotations of all boxes, at the time that was set last. */
export interface PoseSource {
  readonly displacement: Float32Array;
  /** x, y, z, w, as WebGL programs have it */
  readonly rotation: Float32Array;
  set(time: number): void;
}

/** Those of a world at any time. */
export class Poses implements PoseSource {
  readonly displacement: Float32Array;
  readonly rotation: Float32Array;

  constructor(private readonly world: World) {
    const boxes = world.boxes.id.length;
    this.displacement = new Float32Array(3 * boxes);
    this.rotation = new Float32Array(4 * boxes);
    this.set(0);
  }

  /** Positions are interpolated linearly, rotations along the shortest arc. */
  set(time: number): void {
    const { world } = this;
    const boxes = world.boxes.id.length;
    const { sample, share } = between(times(world), time);
    if (!world.series) {
      const done = sample === 1 ? 1 : share;
      for (let i = 0; i < 3 * boxes; ++i) this.displacement[i] = done * world.boxes.endDisplacement[i];
      for (let box = 0; box < boxes; ++box) this.rotation.set([0, 0, 0, 1], 4 * box);
      return;
    }
    const { displacement, orientation } = world.series;
    const next = share > 0 ? sample + 1 : sample;
    const a = 3 * boxes * sample;
    const b = 3 * boxes * next;
    for (let i = 0; i < 3 * boxes; ++i)
      this.displacement[i] = displacement[a + i] + share * (displacement[b + i] - displacement[a + i]);
    for (let box = 0; box < boxes; ++box)
      slerp(orientation, 4 * (boxes * sample + box), 4 * (boxes * next + box), share, this.rotation, 4 * box);
  }
}

/** Angle of the rotation from one orientation w, x, y, z to another, degree. */
export function tiltOf(orientation: ArrayLike<number>, start: number, at: number): number {
  const [a, b, c, d] = [0, 1, 2, 3].map((i) => orientation[start + i]);
  const [w, x, y, z] = [0, 1, 2, 3].map((i) => orientation[at + i]);
  const sine = Math.hypot(x * a - w * b + z * c - y * d, y * a - w * c + x * d - z * b, z * a - w * d + y * b - x * c);
  return (2 * Math.atan2(sine, Math.abs(w * a + x * b + y * c + z * d)) * 180) / Math.PI;
}

/** Quaternions w, x, y, z of the file; x, y, z, w in `out`. */
export function slerp(q: Float32Array, a: number, b: number, share: number, out: Float32Array, at: number): void {
  let cosine = q[a] * q[b] + q[a + 1] * q[b + 1] + q[a + 2] * q[b + 2] + q[a + 3] * q[b + 3];
  const sign = cosine < 0 ? -1 : 1;
  cosine *= sign;
  let from = 1 - share;
  let to = share;
  if (cosine < 0.9995) {
    const angle = Math.acos(cosine);
    from = Math.sin((1 - share) * angle) / Math.sin(angle);
    to = Math.sin(share * angle) / Math.sin(angle);
  }
  to *= sign;
  const w = from * q[a] + to * q[b];
  const x = from * q[a + 1] + to * q[b + 1];
  const y = from * q[a + 2] + to * q[b + 2];
  const z = from * q[a + 3] + to * q[b + 3];
  const length = Math.hypot(w, x, y, z) || 1;
  out[at] = x / length;
  out[at + 1] = y / length;
  out[at + 2] = z / length;
  out[at + 3] = w / length;
}
