import { VERDICT_CODES } from "../data/outcome";
import type { BoxColumns, Results, Series, World, WorldColumns } from "../data/results";
import type { Frame } from "./messages";

/** s: between two samples when that of the file's settings is not of use here. */
const SAMPLING = 0.1;

/** A column that grows. */
class Growing<T extends Float32Array | Float64Array | Uint32Array> {
  private length = 0;

  constructor(private all: T) {}

  add(values: ArrayLike<number>): void {
    if (this.length + values.length > this.all.length) {
      const more = new (this.all.constructor as new (length: number) => T)(2 * (this.length + values.length));
      more.set(this.all.subarray(0, this.length));
      this.all = more;
    }
    this.all.set(values, this.length);
    this.length += values.length;
  }

  get values(): T {
    return this.all.subarray(0, this.length) as T;
  }
}

const newColumns = () => ({
  time: new Growing(new Float64Array(64)),
  acceleration: new Growing(new Float32Array(256)),
  energy: new Growing(new Float32Array(64)),
  fallen: new Growing(new Uint32Array(64)),
  displacement: new Growing(new Float32Array(1024)),
  orientation: new Growing(new Float32Array(1024)),
});

/** Where the centres of mass are as loaded, m. */
export function centresOf(boxes: Float64Array, settings: Readonly<Record<string, string>>): Float64Array {
  const centres = new Float64Array((3 * boxes.length) / 7);
  for (let box = 0; 7 * box < boxes.length; ++box) {
    const row = boxes.subarray(7 * box, 7 * box + 7);
    const offset = (settings[`Material ${row[6]}/CentreOfMass`] ?? "").split(/\s+/).map(Number);
    for (let axis = 0; axis < 3; ++axis)
      centres[3 * box + axis] = (row[axis] + row[axis + 3]) / 2 + (offset[axis] || 0) / 100;
  }
  return centres;
}

/**
 * A world that the engine of this page simulates, recorded in the form of a results file, so that all that shows a recorded world
 * shows this one.
 */
export class LiveRecord {
  readonly results: Results;
  readonly world: World;
  /** s */
  readonly interval: number;
  /** The latest displacements (m) and orientations w, x, y, z. */
  readonly displacement: Float32Array;
  readonly orientation: Float32Array;
  time = 0;
  /** rows of six: velocity (m/s), angular velocity (rad/s) */
  velocities: Float64Array = new Float64Array();
  /** Rows of seven numbers: the layout that it began with. */
  boxes = new Float64Array();
  private readonly zeroOrientation: Float64Array;
  private readonly reference: Float64Array;
  private columns = newColumns();

  constructor(file: Results, of: World) {
    const count = of.boxes.id.length;
    const given = Number(file.settings["Export Settings/ResultsIntervallInSeconds"]);
    this.interval = given >= 1 / 60 && given <= 0.2 ? given : SAMPLING;
    this.reference = new Float64Array(3 * count);
    this.zeroOrientation = new Float64Array(4 * count);
    this.displacement = new Float32Array(3 * count);
    this.orientation = new Float32Array(4 * count);
    const columns: BoxColumns = {
      ...of.boxes,
      reference: new Float32Array(3 * count),
      settling: new Float32Array(3 * count),
      endDisplacement: new Float32Array(3 * count),
      endTilt: new Float32Array(count),
      drop: new Float32Array(count),
      peakDisplacement: new Float32Array(count),
      peakEnergy: new Float32Array(count),
      fallen: new Uint8Array(count),
      moved: new Uint8Array(count),
    };
    this.results = {
      ...file,
      layouts: [of.layout],
      accelerations: [of.acceleration],
      layoutBoxes: Uint32Array.of(count),
      worlds: oneWorld(count),
      hasSeries: true,
      hasWalls: false,
      margins: null,
      replicas: null,
    };
    this.world = {
      ...of,
      index: 0,
      engine: "live",
      status: 0,
      statusText: "",
      verdict: VERDICT_CODES.stayed,
      boxes: columns,
      series: null,
      walls: null,
    };
  }

  /**
   * Begins anew.
   * @param boxes rows of seven numbers
   * @param frame the world at time 0, after settling
   */
  restart(boxes: Float64Array, frame: Frame, acceleration: ArrayLike<number>): void {
    const { settings } = this.results;
    const { reference, settling, peakDisplacement, peakEnergy } = this.world.boxes;
    const loaded = centresOf(boxes, settings);
    const settled = settings["Screening/ReferencePose"] === "settled";
    this.boxes = boxes.slice();
    this.columns = newColumns();
    for (let box = 0; 7 * box < boxes.length; ++box) {
      for (let axis = 0; axis < 3; ++axis) {
        const i = 3 * box + axis;
        settling[i] = frame.poses[7 * box + axis] - loaded[i];
        this.reference[i] = settled ? frame.poses[7 * box + axis] : loaded[i];
      }
      this.zeroOrientation.set(settled ? frame.poses.subarray(7 * box + 3, 7 * box + 7) : [1, 0, 0, 0], 4 * box);
    }
    reference.set(this.reference);
    peakDisplacement.fill(0);
    peakEnergy.fill(0);
    this.results.worlds.peakEnergy[0] = 0;
    this.results.worlds.peakDisplacement[0] = 0;
    this.add(frame, acceleration);
  }

  /** s: the time at which the next sample is due. */
  get nextSample(): number {
    return (Math.floor(this.time / this.interval + 1e-6) + 1) * this.interval;
  }

  /** Takes in the world as it is now; whether a sample was due. */
  add(frame: Frame, acceleration: ArrayLike<number>): boolean {
    const sampled = frame.time === 0 || frame.time >= this.nextSample - 1e-9 || frame.stateHash !== null;
    this.time = frame.time;
    this.velocities = frame.velocities;
    this.world.endTime = frame.time;
    const energy = this.measure(frame);
    this.judge(energy);
    if (sampled) this.sample(frame.time, acceleration, energy);
    return sampled;
  }

  /** Kinetic energy of all boxes, J. */
  private measure({ poses, velocities }: Frame): number {
    const { boxes } = this.world;
    let sum = 0;
    for (let box = 0; box < boxes.id.length; ++box) {
      for (let axis = 0; axis < 3; ++axis)
        this.displacement[3 * box + axis] = poses[7 * box + axis] - this.reference[3 * box + axis];
      this.orientation.set(poses.subarray(7 * box + 3, 7 * box + 7), 4 * box);
      const energy = energyOf(boxes, box, poses.subarray(7 * box + 3, 7 * box + 7), velocities.subarray(6 * box));
      boxes.peakEnergy[box] = Math.max(boxes.peakEnergy[box], energy);
      sum += energy;
    }
    return sum;
  }

  /** Verdict and counts, by the rules of a world that ends now. */
  private judge(energy: number): void {
    const { boxes } = this.world;
    const { worlds, thresholds } = this.results;
    const { displacement } = this;
    let [fallen, moved, tilted, unstable, far] = [0, 0, 0, 0, 0];
    for (let box = 0; box < boxes.id.length; ++box) {
      const at = displacement.subarray(3 * box, 3 * box + 3);
      const distance = Math.hypot(at[0], at[1], at[2]);
      const settled = boxes.settling.subarray(3 * box, 3 * box + 3);
      boxes.drop[box] = 0 - at[2];
      boxes.fallen[box] = boxes.drop[box] > thresholds.drop ? 1 : 0;
      boxes.moved[box] = distance > thresholds.move ? 1 : 0;
      boxes.endTilt[box] = this.tilt(box);
      boxes.peakDisplacement[box] = Math.max(boxes.peakDisplacement[box], distance);
      fallen += boxes.fallen[box];
      moved += boxes.moved[box];
      tilted += boxes.endTilt[box] > thresholds.tilt ? 1 : 0;
      unstable += -settled[2] > thresholds.drop || Math.hypot(...settled) > thresholds.move ? 1 : 0;
      far = Math.max(far, distance);
    }
    boxes.endDisplacement.set(displacement);
    worlds.fallen[0] = fallen;
    worlds.moved[0] = moved;
    worlds.tilted[0] = tilted;
    worlds.unstable[0] = unstable;
    worlds.displacement[0] = far;
    worlds.peakDisplacement[0] = Math.max(worlds.peakDisplacement[0], far);
    worlds.peakEnergy[0] = Math.max(worlds.peakEnergy[0], energy);
    worlds.endTime[0] = this.time;
    this.world.verdict =
      fallen > 0
        ? VERDICT_CODES.fell
        : moved + tilted > 0
          ? VERDICT_CODES.moved
          : unstable > 0
            ? VERDICT_CODES.unstable
            : VERDICT_CODES.stayed;
    worlds.verdict[0] = this.world.verdict;
  }

  /** Degree, from the reference pose. */
  private tilt(box: number): number {
    let cosine = 0;
    for (let i = 4 * box; i < 4 * box + 4; ++i) cosine += this.zeroOrientation[i] * this.orientation[i];
    return (2 * Math.acos(Math.min(1, Math.abs(cosine))) * 180) / Math.PI;
  }

  private sample(time: number, acceleration: ArrayLike<number>, energy: number): void {
    const { columns } = this;
    columns.time.add([time]);
    columns.acceleration.add(acceleration);
    columns.energy.add([energy]);
    columns.fallen.add([this.results.worlds.fallen[0]]);
    columns.displacement.add(this.displacement);
    columns.orientation.add(this.orientation);
    this.results.worlds.samples[0] = columns.time.values.length;
    this.world.series = Object.fromEntries(
      Object.entries(columns).map(([name, column]) => [name, column.values]),
    ) as unknown as Series;
  }
}

/** Kinetic energy of a box of even density, J. */
function energyOf(boxes: BoxColumns, box: number, q: Float64Array, v: Float64Array): number {
  const mass = boxes.mass[box];
  const [a, b, c] = boxes.size.subarray(3 * box, 3 * box + 3);
  const inertia = [b * b + c * c, a * a + c * c, a * a + b * b].map((squares) => (mass * squares) / 12);
  const [w, x, y, z] = q;
  // Columns of the rotation: the box's axes in the frame of the container.
  const axes = [
    [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
    [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
  ];
  let energy = (mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2])) / 2;
  for (let axis = 0; axis < 3; ++axis) {
    const spin = axes[axis][0] * v[3] + axes[axis][1] * v[4] + axes[axis][2] * v[5];
    energy += (inertia[axis] * spin * spin) / 2;
  }
  return energy;
}

function oneWorld(boxes: number): WorldColumns {
  const none = () => new Uint32Array(1);
  return {
    layout: none(),
    acceleration: none(),
    status: none(),
    verdict: new Uint8Array(1),
    boxes: Uint32Array.of(boxes),
    samples: none(),
    fallen: none(),
    unstable: none(),
    moved: none(),
    tilted: none(),
    displacement: new Float32Array(1),
    peakDisplacement: new Float32Array(1),
    peakEnergy: new Float64Array(1),
    endTime: new Float64Array(1),
    cpuSeconds: new Float64Array(1),
    boxBegin: new Float64Array(1),
    sampleBegin: new Float64Array(1),
    rowBegin: new Float64Array(1),
  };
}
