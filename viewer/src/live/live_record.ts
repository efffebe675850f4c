import { centreOfMass } from "../data/centre_of_mass";
import { criticalBox, excursionsTo, isBeyond, noExcursions } from "../data/excursions";
import { STOP_REASON_CODES, VERDICT_CODES } from "../data/outcome";
import {
  type BoxColumns,
  type Excursions,
  emptyWorlds,
  type Results,
  type Series,
  type World,
  type WorldColumns,
} from "../data/results";
import type { Frame } from "../engine/messages";
import { tiltOf } from "../time/poses";

/** s: between two samples when that of the file's settings is not of use here. */
const SAMPLING = 0.1;

/** s: times that are nearer than this differ by rounding alone. */
const SAME_INSTANT = 1e-9;

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
    const offset = centreOfMass(undefined, String(row[6]), settings);
    for (let axis = 0; axis < 3; ++axis) centres[3 * box + axis] = (row[axis] + row[axis + 3]) / 2 + offset[axis];
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
  /** Orientations w, x, y, z of the reference pose, and behind them those of now. */
  private readonly turns: Float64Array;
  private readonly reference: Float64Array;
  private columns = newColumns();

  constructor(file: Results, of: World) {
    const count = of.boxes.id.length;
    const given = Number(file.settings["Export Settings/ResultsIntervallInSeconds"]);
    this.interval = given >= 1 / 60 && given <= 0.2 ? given : SAMPLING;
    this.reference = new Float64Array(3 * count);
    this.turns = new Float64Array(8 * count);
    this.displacement = new Float32Array(3 * count);
    this.orientation = new Float32Array(4 * count);
    const peak = noExcursions(count);
    const columns: BoxColumns = {
      ...of.boxes,
      reference: new Float32Array(3 * count),
      endDisplacement: new Float32Array(3 * count),
      end: noExcursions(count),
      peak,
      settling: noExcursions(count),
      judged: peak,
      peakEnergy: new Float32Array(count),
      firstBeyond: new Float32Array(count),
      fallen: new Uint8Array(count),
      moved: new Uint8Array(count),
      tilted: new Uint8Array(count),
      unstable: new Uint8Array(count),
      damage: undefined,
    };
    this.results = {
      ...file,
      settings: { ...file.settings, ...of.loaded?.settings },
      judgedAtEnd: false,
      layouts: [of.layout],
      accelerations: [of.acceleration],
      layoutBoxes: Uint32Array.of(count),
      worlds: oneWorld(count),
      hasSeries: true,
      hasWalls: false,
      margins: null,
      replicas: null,
      damage: undefined,
      hardestWalls: undefined,
    };
    this.world = {
      ...of,
      index: 0,
      engine: "live",
      status: 0,
      statusText: "",
      verdict: VERDICT_CODES.stayed,
      stopReason: STOP_REASON_CODES.timeout,
      accelerated: true,
      criticalBox: 0,
      beginTime: 0,
      stateHash: "",
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
    const { settings, thresholds } = this.results;
    const { world } = this;
    const { peak, settling, unstable, firstBeyond, peakEnergy } = world.boxes;
    this.boxes = boxes.slice();
    this.columns = newColumns();
    this.refer(frame.poses, false);
    this.measure(frame);
    copy(this.excursions(), settling);
    // How far boxes were on the way there is not known here.
    for (let box = 0; box < unstable.length; ++box) unstable[box] = isBeyond(settling, box, thresholds) ? 1 : 0;
    world.accelerated = !unstable.includes(1);
    if (world.accelerated && settings["Screening/ReferencePose"] === "settled") this.refer(frame.poses, true);
    for (const column of [peak.displacement, peak.drop, peak.tilt, peakEnergy]) column.fill(0);
    firstBeyond.fill(Number.NaN);
    this.results.worlds.peakEnergy[0] = 0;
    this.add(frame, acceleration);
  }

  /** Takes the poses at time 0, or those as loaded, as what displacement and tilt are from. */
  private refer(poses: Float64Array, settled: boolean): void {
    const loaded = centresOf(this.boxes, this.results.settings);
    for (let box = 0; 3 * box < loaded.length; ++box) {
      this.reference.set(
        settled ? poses.subarray(7 * box, 7 * box + 3) : loaded.subarray(3 * box, 3 * box + 3),
        3 * box,
      );
      this.turns.set(settled ? poses.subarray(7 * box + 3, 7 * box + 7) : [1, 0, 0, 0], 4 * box);
    }
    this.world.boxes.reference.set(this.reference);
  }

  /** s: the time at which the next sample is due. */
  get nextSample(): number {
    return (Math.floor(this.time / this.interval + 1e-6) + 1) * this.interval;
  }

  /** Takes in the world as it is now; whether a sample was due. */
  add(frame: Frame, acceleration: ArrayLike<number>): boolean {
    const last = this.columns.time.values.at(-1) ?? Number.NEGATIVE_INFINITY;
    const due = frame.time >= this.nextSample - SAME_INSTANT || frame.stateHash !== null;
    const sampled = frame.time === 0 || (due && frame.time > last + SAME_INSTANT);
    this.time = frame.time;
    this.velocities = frame.velocities;
    this.world.endTime = frame.time;
    this.world.stateHash = frame.stateHash ?? "";
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
      const orientation = poses.subarray(7 * box + 3, 7 * box + 7);
      this.orientation.set(orientation, 4 * box);
      this.turns.set(orientation, this.orientation.length + 4 * box);
      const energy = energyOf(boxes, box, orientation, velocities.subarray(6 * box));
      boxes.peakEnergy[box] = Math.max(boxes.peakEnergy[box], energy);
      sum += energy;
    }
    return sum;
  }

  /** How far boxes are now. */
  private excursions(): Excursions {
    const { turns } = this;
    const tilt = Float32Array.from(this.world.boxes.id, (_, box) => tiltOf(turns, 4 * box, turns.length / 2 + 4 * box));
    return excursionsTo(this.displacement, tilt);
  }

  /** Verdict and counts of all that has happened so far, by the rules of the program. */
  private judge(energy: number): void {
    const { world } = this;
    const { boxes } = world;
    const { worlds, thresholds } = this.results;
    const { end, peak, firstBeyond } = boxes;
    copy(this.excursions(), end);
    boxes.endDisplacement.set(this.displacement);
    for (let box = 0; box < boxes.id.length; ++box) {
      for (const name of ["displacement", "drop", "tilt"] as const)
        peak[name][box] = Math.max(peak[name][box], end[name][box]);
      boxes.fallen[box] = peak.drop[box] > thresholds.drop ? 1 : 0;
      boxes.moved[box] = peak.displacement[box] > thresholds.move ? 1 : 0;
      boxes.tilted[box] = peak.tilt[box] > thresholds.tilt ? 1 : 0;
      // When a load went beyond a limit while it settled is not known here.
      if (world.accelerated && Number.isNaN(firstBeyond[box]) && isBeyond(peak, box, thresholds))
        firstBeyond[box] = this.time;
    }
    const number = (flags: Uint8Array) => flags.reduce((sum, flag) => sum + flag, 0);
    const most = (column: Float32Array) => column.reduce((largest, value) => Math.max(largest, value), 0);
    worlds.fallen[0] = number(boxes.fallen);
    worlds.moved[0] = number(boxes.moved);
    worlds.tilted[0] = number(boxes.tilted);
    worlds.unstable[0] = number(boxes.unstable);
    worlds.fallenAtEnd[0] = end.drop.reduce((sum, drop) => sum + (drop > thresholds.drop ? 1 : 0), 0);
    worlds.peakDisplacement[0] = most(peak.displacement);
    worlds.peakDrop[0] = most(peak.drop);
    worlds.peakTilt[0] = most(peak.tilt);
    worlds.endDisplacement[0] = most(end.displacement);
    worlds.peakEnergy[0] = Math.max(worlds.peakEnergy[0], energy);
    worlds.endTime[0] = this.time;
    world.criticalBox = worlds.criticalBox[0] = criticalBox(firstBeyond, peak, thresholds);
    const { unstable, fell, moved, stayed } = VERDICT_CODES;
    world.verdict =
      worlds.unstable[0] > 0
        ? unstable
        : worlds.fallen[0] > 0
          ? fell
          : worlds.moved[0] + worlds.tilted[0] > 0
            ? moved
            : stayed;
    worlds.verdict[0] = world.verdict;
  }

  private sample(time: number, acceleration: ArrayLike<number>, energy: number): void {
    const { columns } = this;
    columns.time.add([time]);
    columns.acceleration.add(acceleration);
    columns.energy.add([energy]);
    columns.fallen.add([this.results.worlds.fallenAtEnd[0]]);
    columns.displacement.add(this.displacement);
    columns.orientation.add(this.orientation);
    this.results.worlds.samples[0] = columns.time.values.length;
    this.world.series = Object.fromEntries(
      Object.entries(columns).map(([name, column]) => [name, column.values]),
    ) as unknown as Series;
  }
}

function copy(from: Excursions, to: Excursions): void {
  to.displacement.set(from.displacement);
  to.drop.set(from.drop);
  to.tilt.set(from.tilt);
}

/** Kinetic energy of a box of even density, J; 0 where it is fixed. */
function energyOf(boxes: BoxColumns, box: number, q: Float64Array, v: Float64Array): number {
  if (boxes.fixed[box]) return 0;
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
  return {
    ...emptyWorlds(1),
    stopReason: Uint8Array.of(STOP_REASON_CODES.timeout),
    boxes: Uint32Array.of(boxes),
  };
}
