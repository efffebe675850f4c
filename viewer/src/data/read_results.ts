import { readContainers } from "./containers";
import { criticalBox, excursionsTo } from "./excursions";
import { type Hdf5File, type Numbers, UnreadableFile } from "./hdf5_file";
import { fixedMaterials, UPRIGHT } from "./openings";
import { VERDICT_CODES } from "./outcome";
import { LoadInputs } from "./read_loads";
import {
  type BoxColumns,
  type BoxDamage,
  type Damage,
  type Excursions,
  type HardestWalls,
  type MarginColumns,
  type Margins,
  NOT_COUNTED,
  PRESSED,
  type Replicas,
  type Results,
  type Segment,
  type Series,
  type WallForces,
  type World,
  type WorldColumns,
} from "./results";

/** Versions of the file that this page reads. */
const VERSIONS = [1, 2, 3];
/** The first version that has what boxes ever did. */
const PEAKS_SINCE = 3;
/** Code of a verdict of earlier versions: the world ended with a box beyond a limit. */
const GAVE_WAY = 5;

const uint32 = (numbers: Numbers) => (numbers instanceof Uint32Array ? numbers : Uint32Array.from(numbers));

/** Reads a results file: its summary at once, a world when it is asked for. */
export class ResultsReader {
  private readonly loads: LoadInputs;

  private constructor(
    private readonly file: Hdf5File,
    readonly results: Results,
    private readonly offsets: Record<"boxes" | "samples" | "rows" | "layoutBoxes", number>,
  ) {
    this.loads = new LoadInputs(file, results, offsets.layoutBoxes);
  }

  static read(file: Hdf5File, name: string, size: number): ResultsReader {
    const root = file.attributes("/");
    if (root.format !== "holdfast results")
      throw new UnreadableFile(`${name} is an HDF5 file, but no results of holdfast.`);
    if (!VERSIONS.includes(Number(root.format_version)))
      throw new UnreadableFile(
        `${name} has version ${root.format_version} of the format; this page reads version ${VERSIONS.join(", ")}.`,
      );
    const offsets = {
      boxes: Number(root.boxes_begin ?? 0),
      samples: Number(root.samples_begin ?? 0),
      rows: Number(root.rows_begin ?? 0),
      layoutBoxes: Number(root.layout_boxes_begin ?? 0),
    };
    return new ResultsReader(file, readSummary(file, root, name, size), offsets);
  }

  world(index: number): World {
    const { results, file } = this;
    const { worlds } = results;
    const layout = worlds.layout[index];
    const acceleration = worlds.acceleration[index];
    const endTime = worlds.endTime[index];
    const accelerated = results.judgedAtEnd || (worlds.verdict[index] !== VERDICT_CODES.unstable && !(endTime < 0));
    const boxes = this.boxes(index, accelerated);
    return {
      index,
      layout: results.layouts[layout] ?? "",
      container: results.ownContainers.get(layout) ?? results.container,
      acceleration: results.accelerations[acceleration] ?? "",
      segments: results.segments[acceleration] ?? [],
      engine: file.texts("worlds/engine", index, index + 1)[0],
      status: worlds.status[index],
      statusText: file.texts("worlds/status_text", index, index + 1)[0],
      verdict: worlds.verdict[index],
      stopReason: worlds.stopReason[index],
      accelerated,
      criticalBox: results.judgedAtEnd ? this.criticalBox(index, boxes) : worlds.criticalBox[index],
      beginTime: accelerated ? 0 : -Number(results.settings["Screening/SettleSeconds"]),
      endTime,
      boxes,
      series: this.series(index),
      walls: this.walls(index),
      stateHash: file.hashes("worlds/state_hash", index, index + 1)[0],
      loaded: this.loads.layout(layout, boxes),
    };
  }

  /** Names of the boxes that are critical, per world; empty where there is none, or it has no name. */
  criticalNames(): string[] {
    const { worlds } = this.results;
    const ofLayouts = new Map<number, string[]>();
    return Array.from(worlds.layout, (layout, world) => {
      const box = worlds.criticalBox[world];
      if (box === 0 || box === NOT_COUNTED) return "";
      const names = ofLayouts.get(layout) ?? this.loads.names(layout);
      ofLayouts.set(layout, names);
      return names[box - 1] ?? "";
    });
  }

  close(): void {
    this.file.close();
  }

  private boxes(index: number, accelerated: boolean): BoxColumns {
    const { file, results } = this;
    const begin = results.worlds.boxBegin[index] - this.offsets.boxes;
    const end = begin + results.worlds.boxes[index];
    const column = (name: string) => file.numbers(name, begin, end);
    const float = (name: string) => column(name) as Float32Array;
    const flags = (name: string) => column(`summary/boxes/${name}`) as Uint8Array;
    const initial = Float32Array.from(column("boxes/initial_position"));
    const reference = initial.slice();
    const settling = float("boxes/settling_displacement");
    if (accelerated && results.settings["Screening/ReferencePose"] === "settled")
      for (let i = 0; i < reference.length; ++i) reference[i] += settling[i];
    const endDisplacement = float("boxes/end_displacement");
    const atEnd = excursionsTo(endDisplacement, float("boxes/end_tilt"));
    const unknown = () => new Float32Array(end - begin).fill(Number.NaN);
    const peaks = (name: string): Excursions => ({
      displacement: float(`boxes/${name}_displacement`),
      drop: float(`boxes/${name}_drop`),
      tilt: float(`boxes/${name}_tilt`),
    });
    const earlier = results.judgedAtEnd;
    const fixed = fixedMaterials(results.settings);
    const load = this.loads.boxes(results.worlds.layout[index], column("boxes/material"));
    const damage = results.damage && accelerated ? this.damage(begin, end) : undefined;
    const peak = earlier
      ? { displacement: float("boxes/peak_displacement"), drop: unknown(), tilt: unknown() }
      : peaks("peak");
    return {
      id: column("boxes/id") as Uint32Array,
      name: load.name,
      material: load.material,
      mat: load.mat,
      bearingLimit: load.bearingLimit,
      fixed: Uint8Array.from(load.material, (name, box) => (load.fixed[box] || fixed.has(name) ? 1 : 0)),
      mass: float("boxes/mass"),
      size: float("boxes/size"),
      centre: load.centre,
      initial,
      reference,
      endDisplacement,
      end: atEnd,
      peak,
      settling: earlier ? excursionsTo(settling, new Float32Array(end - begin)) : peaks("settling_peak"),
      judged: earlier ? atEnd : peak,
      peakEnergy: float("boxes/peak_kinetic_energy"),
      firstBeyond: earlier ? unknown() : float("summary/boxes/first_beyond"),
      fallen: flags("fallen"),
      moved: flags("moved"),
      tilted: flags("tilted"),
      unstable: flags("unstable"),
      damage,
    };
  }

  private damage(begin: number, end: number): BoxDamage {
    const column = (name: string) => this.file.numbers(`damage/${name}`, begin, end);
    return {
      acceleration: column("peak_acceleration") as Float32Array,
      velocityChange: column("velocity_change") as Float32Array,
      beyond: column("beyond") as Uint8Array,
    };
  }

  /** Of a world of an earlier version, by where boxes are at the end. */
  private criticalBox(index: number, { firstBeyond, settling, end }: BoxColumns): number {
    const { worlds, thresholds } = this.results;
    if (firstBeyond.length === 0) return NOT_COUNTED;
    return criticalBox(firstBeyond, worlds.unstable[index] > 0 ? settling : end, thresholds);
  }

  private series(index: number): Series | null {
    const { worlds, hasSeries } = this.results;
    const samples = worlds.samples[index];
    if (!hasSeries || samples === 0) return null;
    const sample = worlds.sampleBegin[index] - this.offsets.samples;
    const row = worlds.rowBegin[index] - this.offsets.rows;
    const bySample = (name: string) => this.file.numbers(`series/${name}`, sample, sample + samples);
    const byRow = (name: string) => this.file.numbers(`series/${name}`, row, row + samples * worlds.boxes[index]);
    return {
      time: bySample("time") as Float64Array,
      acceleration: bySample("container_acceleration") as Float32Array,
      energy: bySample("total_kinetic_energy") as Float32Array,
      fallen: bySample("fallen_count") as Uint32Array,
      displacement: byRow("displacement") as Float32Array,
      orientation: byRow("orientation") as Float32Array,
    };
  }

  private walls(index: number): WallForces | null {
    const { file, results } = this;
    if (!results.hasWalls) return null;
    const column = (name: string) => file.numbers(`walls/${name}`, index, index + 1) as Float64Array;
    const sample = results.worlds.sampleBegin[index] - this.offsets.samples;
    const samples = results.worlds.samples[index];
    const lasting = column("lasting_force");
    if (Number.isNaN(lasting[0])) return null; // the world was not accelerated
    const force = samples > 0 && file.has("walls/force") ? file.numbers("walls/force", sample, sample + samples) : [];
    return {
      peak: column("peak_force"),
      lasting,
      limit: column("limit"),
      force: Float32Array.from(force),
    };
  }
}

function readSummary(file: Hdf5File, root: Record<string, string | number>, name: string, size: number): Results {
  const settings: Record<string, string> = {};
  for (const [key, value] of Object.entries(file.attributes("inputs/settings"))) settings[key] = String(value);
  const thresholds = file.attributes("summary");
  const judgedAtEnd = Number(root.format_version) < PEAKS_SINCE;
  return {
    name,
    size,
    complete: Number(root.complete) === 1,
    firstWorld: Number(root.worlds_begin ?? 0),
    engine: String(root.engine),
    software: String(root.software),
    created: String(root.created_utc),
    settings,
    thresholds: {
      drop: Number(thresholds.drop_threshold),
      move: Number(thresholds.move_threshold),
      tilt: Number(thresholds.tilt_threshold),
    },
    judgedAtEnd,
    ...readContainers(file, settings),
    layouts: file.texts("inputs/layouts/name"),
    layoutBoxes: uint32(file.numbers("inputs/layouts/box_count")),
    accelerations: file.texts("inputs/accelerations/name"),
    segments: readSegments(file),
    worlds: {
      ...readWorlds(file, Number(root.layouts_begin ?? 0), Number(root.accelerations_begin ?? 0)),
      ...(judgedAtEnd ? readEnds(file) : readPeaks(file)),
    },
    hasSeries: file.has("series/displacement"),
    hasWalls: file.has("walls"),
    margins: readMargins(file),
    replicas: readReplicas(file),
    damage: readDamage(file, settings),
    hardestWalls: readHardestWalls(file, settings),
  };
}

function readDamage(file: Hdf5File, settings: Readonly<Record<string, string>>): Damage | undefined {
  if (!file.has("damage")) return undefined;
  return {
    boxesBeyond: uint32(file.numbers("damage/boxes_beyond")),
    boundary: {
      acceleration: Number(settings["Screening/CriticalAcceleration"]),
      velocityChange: Number(settings["Screening/CriticalVelocityChange"]),
    },
  };
}

function readHardestWalls(file: Hdf5File, settings: Readonly<Record<string, string>>): HardestWalls | undefined {
  if (!file.has("walls")) return undefined;
  const [force, limit] = ["lasting_force", "limit"].map((name) => file.numbers(`walls/${name}`));
  const worlds = file.numbers("worlds/layout").length;
  const sides = force.length / worlds;
  const upright = UPRIGHT.map(({ name }) => PRESSED.indexOf(name));
  const most = (of: (at: number) => number) =>
    Float64Array.from({ length: worlds }, (_, world) => {
      const known = upright.map((side) => of(sides * world + side)).filter((value) => !Number.isNaN(value));
      return known.length > 0 ? Math.max(...known) : Number.NaN;
    });
  const forces = most((at) => force[at]);
  return {
    force: forces,
    most: forces.reduce((sofar, value) => (value > sofar ? value : sofar), 0),
    share: most((at) => (limit[at] > 0 ? force[at] / limit[at] : Number.NaN)),
    norm: settings["Screening/Walls"] ?? "",
  };
}

function readSegments(file: Hdf5File): Segment[][] {
  const begin = file.numbers("inputs/accelerations/segment_begin");
  const count = file.numbers("inputs/accelerations/segment_count");
  const start = file.numbers("inputs/accelerations/start");
  const duration = file.numbers("inputs/accelerations/duration");
  const value = file.numbers("inputs/accelerations/value");
  return Array.from(begin, (first, acceleration) =>
    Array.from({ length: count[acceleration] }, (_, i) => ({
      start: start[first + i],
      duration: duration[first + i],
      value: [value[3 * (first + i)], value[3 * (first + i) + 1], value[3 * (first + i) + 2]],
    })),
  );
}

type Judged =
  | "verdict"
  | "statusTime"
  | "caveats"
  | "fallenAtEnd"
  | "criticalBox"
  | "peakDrop"
  | "peakTilt"
  | "endDisplacement";

/** What all versions have. */
function readWorlds(file: Hdf5File, firstLayout: number, firstAcceleration: number): Omit<WorldColumns, Judged> {
  const world = (name: string) => file.numbers(`worlds/${name}`);
  const summary = (name: string) => file.numbers(`summary/worlds/${name}`);
  return {
    layout: Uint32Array.from(world("layout"), (layout) => layout - firstLayout),
    acceleration: Uint32Array.from(world("acceleration"), (acceleration) => acceleration - firstAcceleration),
    status: uint32(world("status")),
    stopReason: world("stop_reason") as Uint8Array,
    boxes: uint32(world("box_count")),
    samples: uint32(world("sample_count")),
    fallen: uint32(summary("fallen_boxes")),
    unstable: uint32(summary("unstable_boxes")),
    moved: uint32(summary("moved_boxes")),
    tilted: uint32(summary("tilted_boxes")),
    peakDisplacement: summary("peak_displacement") as Float32Array,
    peakEnergy: summary("peak_kinetic_energy") as Float64Array,
    endTime: world("end_time") as Float64Array,
    cpuSeconds: world("cpu_seconds") as Float64Array,
    boxBegin: world("box_begin") as Float64Array,
    sampleBegin: world("sample_begin") as Float64Array,
    rowBegin: world("row_begin") as Float64Array,
  };
}

function readPeaks(file: Hdf5File): Pick<WorldColumns, Judged> {
  const summary = (name: string) => file.numbers(`summary/worlds/${name}`);
  return {
    verdict: summary("verdict") as Uint8Array,
    statusTime: file.numbers("worlds/status_time") as Float64Array,
    caveats: uint32(file.numbers("worlds/caveats")),
    fallenAtEnd: uint32(summary("fallen_at_end")),
    criticalBox: uint32(summary("critical_box")),
    peakDrop: summary("peak_drop") as Float32Array,
    peakTilt: summary("peak_tilt") as Float32Array,
    endDisplacement: summary("end_displacement") as Float32Array,
  };
}

/** The same of an earlier version, as far as it has it. */
function readEnds(file: Hdf5File): Pick<WorldColumns, Judged> {
  const summary = (name: string) => file.numbers(`summary/worlds/${name}`);
  const fallen = uint32(summary("fallen_boxes"));
  const { fell, moved } = VERDICT_CODES;
  const unknown = () => new Float32Array(fallen.length).fill(Number.NaN);
  return {
    verdict: Uint8Array.from(summary("verdict"), (verdict, world) =>
      verdict !== GAVE_WAY ? verdict : fallen[world] > 0 ? fell : moved,
    ),
    statusTime: new Float64Array(fallen.length).fill(Number.NaN),
    caveats: new Uint32Array(fallen.length),
    fallenAtEnd: fallen,
    criticalBox: new Uint32Array(fallen.length).fill(NOT_COUNTED),
    peakDrop: unknown(),
    peakTilt: unknown(),
    endDisplacement: summary("max_displacement") as Float32Array,
  };
}

function readMargins(file: Hdf5File): Margins | null {
  if (!file.has("margins")) return null;
  const columns = (kind: string): MarginColumns => ({
    margin: file.numbers(`margins/margin${kind}`) as Float64Array,
    criticalBox: uint32(file.numbers(`margins/critical_box${kind}`)),
  });
  return {
    inPlace: columns(""),
    withinLimits: file.has("margins/margin_within_limits") ? columns("_within_limits") : null,
  };
}

function readReplicas(file: Hdf5File): Replicas | null {
  if (!file.has("replicas")) return null;
  return {
    count: uint32(file.numbers("replicas/count")),
    failed: uint32(file.numbers("replicas/failed")),
    share: file.numbers("replicas/share") as Float64Array,
    low: file.numbers("replicas/wilson_low") as Float64Array,
    high: file.numbers("replicas/wilson_high") as Float64Array,
  };
}
