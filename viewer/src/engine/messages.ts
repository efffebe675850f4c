import type {
  Catalogue,
  Columns,
  Engine,
  GivenSettings,
  Load,
  ReadChoices,
  ReadFile,
  ReadLoad,
  RunFacts,
  RunSettings,
  TableRow,
  WorldOutcome,
} from "holdfast-engine";

export type Vector = [number, number, number];

/** What the engine is given: rows of seven and of five numbers, and settings, as of its `world`. */
export interface LiveInputs {
  boxes: Float64Array;
  segments: Float64Array;
  /** one per box, NaN where it has none; null: none has */
  masses: Float64Array | null;
  mats: Float64Array | null;
  settings: NonNullable<GivenSettings["settings"]>;
}

/** What the driver changes from the time of the world on. */
export interface Changes {
  /** m/s² */
  acceleration?: Vector;
  /** of all pairs */
  friction?: number;
  /** N, at a point of the container that goes with the box */
  force?: { box: number; force: Vector; point: Vector };
}

/** The world at a time. */
export interface Frame {
  time: number;
  /** rows of seven: centre of mass (m), quaternion w, x, y, z */
  poses: Float64Array;
  /** rows of six: velocity (m/s), angular velocity (rad/s) */
  velocities: Float64Array;
  /** where it was asked for */
  stateHash: string | null;
  /** s that the engine took */
  computed: number;
}

/** A load of a file, with what the results file has of the text that it is from. */
export interface HashedLoad extends ReadLoad {
  /** hexadecimal; empty where the browser has none */
  sha256: string;
}

export interface HashedFile extends ReadFile {
  loads: HashedLoad[];
}

/** A world that was simulated: what became of it, and what the results file has of its boxes and samples. */
export interface SimulatedWorld {
  outcome: WorldOutcome;
  columns: Columns;
  /** that the engine took */
  seconds: number;
}

/** Margins that were found: columns of four directions, and how many accelerations were tried. */
export interface FoundMargins {
  columns: Columns;
  /** that the engine took */
  seconds: number;
}

/** What page and engine say to each other. */
export interface Orders {
  version: { ask: object; answer: string };
  start: { ask: LiveInputs & { hashed: boolean }; answer: Frame };
  advance: { ask: { to: number; changes: Changes; hashed: boolean }; answer: Frame };
  /** What `holdfast screen` says of files of which these are the texts. */
  screen: {
    ask: { load: string; acceleration: string; settings: LiveInputs["settings"] };
    answer: WorldOutcome;
  };
  catalogue: { ask: object; answer: Catalogue };
  run: { ask: { settings: RunSettings }; answer: RunFacts };
  read: {
    ask: { name: string; bytes: Uint8Array<ArrayBuffer>; choices: GivenSettings & ReadChoices };
    answer: HashedFile;
  };
  preview: { ask: { bytes: Uint8Array; rows: number }; answer: TableRow[] };
  world: { ask: { load: Load; acceleration: number; settings: RunSettings }; answer: SimulatedWorld };
  /** In one direction. */
  margins: { ask: { load: Load; settings: RunSettings; direction: number }; answer: FoundMargins };
  bearing: { ask: { load: Load; settings: RunSettings }; answer: ReturnType<Engine["loadBearing"]> };
}
export type Order = { [K in keyof Orders]: { id: number; kind: K } & Orders[K]["ask"] }[keyof Orders];
export type Answer = { id: number } & ({ value: Orders[keyof Orders]["answer"] } | { error: string });
