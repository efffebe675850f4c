// Types of build/viewer/engine.mjs, which glue.mjs documents.
import type { WorldOutcome } from "../src/data/outcome";

export type { WorldOutcome };

/** What the user, or the calling program, has given that cannot be used: a sentence. */
export class EngineError extends Error {}

export type Numbers = ArrayLike<number>;

/** What settings a world has: the text of a config.ini, and keys that are set after it: section, key, value. */
export interface GivenSettings {
  config?: string;
  settings?: readonly (readonly [string, string, string])[];
}

/** One layout under one acceleration. */
export interface WorldInputs extends GivenSettings {
  /** Rows of seven numbers: corner with the smallest coordinates, corner with the largest (m), material. */
  boxes: Numbers;
  /** Rows of five numbers: start, duration (s), acceleration along x, y, z (m/s²). */
  segments: Numbers;
  /** kg, one per box; not a number: by its material. */
  masses?: Numbers | null;
  /** Coefficients of friction of the mats beneath boxes, one per box; not a number: none. */
  mats?: Numbers | null;
}

/** A world that is taken forward in pieces. */
export interface World {
  readonly boxCount: number;
  /** s */
  readonly time: number;
  /** s, the latest: a load that rests earlier stays as it is until then */
  readonly endTime: number;
  advance(time: number): void;
  /** Rows of seven numbers: centre of mass (m), quaternion w x y z. */
  poses(): Float64Array;
  /** Rows of six numbers: velocity (m/s), angular velocity (rad/s). */
  velocities(): Float64Array;
  /** Rows of three numbers, N: floor, front, rear, left, right, roof, ground, fixed boxes; with the setting WallForces. */
  sideForces(): Float64Array;
  stateHash(): string;
  /** m/s² */
  setAcceleration(acceleration: Numbers): void;
  setFriction(boxBox: number, boxFloor: number, boxWall: number): void;
  /** N; the point in m, container frame. */
  setForce(box: number, force: Numbers, point?: Numbers | null): void;
  free(): void;
}

/** A container as JSON of ours has it: docs/start/loads.md. Lengths in m. */
export interface Shape {
  type?: string;
  size: [number, number, number];
  open_sides?: string[];
  drop_sides?: Record<string, number>;
  bed_height?: number;
}

/** A box of a load, the same. */
export interface LoadBox {
  corner_min: [number, number, number];
  corner_max: [number, number, number];
  name?: string;
  material: number | string;
  /** kg */
  mass?: number;
  centre_of_mass?: [number, number, number];
  mat?: number;
  fixed?: boolean;
  order?: number;
  /** kg */
  bearing_limit?: number;
}

/** A load, the same: all that it says. */
export interface Load {
  name: string;
  container?: Shape;
  boxes: LoadBox[];
}

/** What is wrong with an input, or has to be known of it. */
export interface Problem {
  /** the whole sentence, as the program prints it: file:line:column: what: value; accepted */
  message: string;
  file: string;
  /** from 1; 0: it is not about one */
  line: number;
  column: number;
  what: string;
  value: string;
  /** what would be accepted; options of the program among it */
  accepted: string;
}

/** A load of a file; one with errors cannot be used, and has no boxes. */
export interface ReadLoad {
  name: string;
  /** first line of a layout file */
  header: string;
  boxCount: number;
  /** kg, of what is not fixed */
  mass: number;
  errors: Problem[];
  warnings: Problem[];
  load: Load;
}

/** All loads of a file. */
export interface ReadFile {
  /** what it was taken for, in words */
  form: string;
  /** of the file as a whole */
  notes: Problem[];
  /** why none of its loads can be read; empty: they can */
  errors: Problem[];
  loads: ReadLoad[];
}

/** The same, with each load as the program writes it, without its name: the text that it is known by. */
export interface WrittenFile extends ReadFile {
  loads: (ReadLoad & { json: string })[];
}

/** A row of a table: its line in the text, from 1, and its cells. */
export interface TableRow {
  line: number;
  cells: string[];
}

/** How files are read, as options of the program: `--container` and so on. */
export interface ReadChoices {
  container?: string;
  unit?: string;
  axes?: string;
  format?: string;
  columns?: string;
}

/** What there is to choose from, with where its numbers are from. */
export interface Catalogue {
  containers: { name: string; what: string; payload: number; source: string; shape: Shape }[];
  norms: { name: string; numbers: string; source: string; takesSize: boolean }[];
  friction: { name: string; materials: string; dry: number; wet: number | null }[];
  frictionSource: string;
  formats: { name: string; what: string }[];
}

/** What a run has with some settings. */
export interface RunFacts {
  /** all settings, as the results file has them */
  settings: Record<string, string>;
  /** of loads that have none of their own */
  container: Shape;
  /** of verdicts: m, m, degree */
  limits: { drop: number; move: number; tilt: number };
  /** that the settings name */
  norm: {
    name: string;
    numbers: string;
    source: string;
    /** g: front, rear, left, right */
    neededMargins: [number, number, number, number];
    accelerations: {
      name: string;
      purpose: string;
      segments: { start: number; duration: number; value: [number, number, number] }[];
    }[];
  } | null;
}

/** Columns of numbers by their names. */
export type Columns = Record<string, Float64Array>;

export type RunSettings = GivenSettings & Pick<ReadChoices, "container">;

export interface Engine {
  readonly version: string;
  catalogue(): Catalogue;
  run(inputs?: RunSettings): RunFacts;
  /** The first rows of a table. */
  preview(bytes: Uint8Array, rows: number): TableRow[];
  readLoads(content: string | Uint8Array, name: string, inputs?: GivenSettings & ReadChoices): WrittenFile;
  /**
   * What `holdfast screen` says of a load under an acceleration, by its number in the norm or by rows of five numbers, and what the
   * results file has of its boxes.
   */
  screenLoad(load: Load, acceleration: number | Numbers, inputs: RunSettings, recorded?: boolean): { outcome: WorldOutcome; columns: Columns };
  /** What `holdfast margins` finds: four directions in each column, of which the given one is searched alone. */
  loadMargins(load: Load, inputs: RunSettings, direction?: number): Columns;
  /** What `holdfast check --bearing` finds: columns of boxes, kg. */
  loadBearing(load: Load, inputs: RunSettings): { least: Float64Array; largest: Float64Array };
  readLayout(text: string, inputs?: GivenSettings & { name?: string }): Float64Array;
  readAcceleration(text: string, name?: string): Float64Array;
  /** What `holdfast screen` says of the world; `cpuSeconds` is 0, since the engine here has no clock. */
  screen(inputs: WorldInputs): WorldOutcome;
  world(inputs: WorldInputs): World;
}

/** Compiles the engine. */
export function loadEngine(): Promise<Engine>;
