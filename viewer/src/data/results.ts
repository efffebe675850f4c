/** What the page knows of a results file: plain columns, in the units and frame of docs/results_file.md. */

export interface Segment {
  start: number;
  duration: number;
  value: [number, number, number];
}

export interface Thresholds {
  /** m */
  drop: number;
  /** m */
  move: number;
  /** degree */
  tilt: number;
}

/** One entry per world of the file. */
export interface WorldColumns {
  layout: Uint32Array;
  acceleration: Uint32Array;
  status: Uint32Array;
  verdict: Uint8Array;
  boxes: Uint32Array;
  samples: Uint32Array;
  fallen: Uint32Array;
  unstable: Uint32Array;
  moved: Uint32Array;
  tilted: Uint32Array;
  /** m, at the end, as the verdict uses it */
  displacement: Float32Array;
  /** m, over all steps */
  peakDisplacement: Float32Array;
  /** J */
  peakEnergy: Float64Array;
  endTime: Float64Array;
  cpuSeconds: Float64Array;
  /** Rows of the file at which the world's entries begin. */
  boxBegin: Float64Array;
  sampleBegin: Float64Array;
  rowBegin: Float64Array;
}

export interface Margins {
  /** g, four per layout: front, rear, left, right */
  margin: Float64Array;
  criticalBox: Uint32Array;
}

export interface Replicas {
  count: Uint32Array;
  failed: Uint32Array;
  share: Float64Array;
  low: Float64Array;
  high: Float64Array;
}

/** The summary of a file: everything but boxes and series. */
export interface Results {
  name: string;
  size: number;
  complete: boolean;
  firstWorld: number;
  engine: string;
  software: string;
  created: string;
  settings: Record<string, string>;
  thresholds: Thresholds;
  /** m: length, width, height */
  container: [number, number, number];
  layouts: string[];
  layoutBoxes: Uint32Array;
  accelerations: string[];
  segments: Segment[][];
  worlds: WorldColumns;
  hasSeries: boolean;
  hasWalls: boolean;
  margins: Margins | null;
  replicas: Replicas | null;
}

/** One entry per box, in the order of the layout file; tables of three lie one after the other. */
export interface BoxColumns {
  id: Uint32Array;
  material: Int32Array;
  mass: Float32Array;
  size: Float32Array;
  /** m, at t = 0: as loaded, and settled where displacement counts from there */
  reference: Float32Array;
  /** m, while settling under gravity alone, before t = 0 */
  settling: Float32Array;
  endDisplacement: Float32Array;
  endTilt: Float32Array;
  drop: Float32Array;
  peakDisplacement: Float32Array;
  peakEnergy: Float32Array;
  fallen: Uint8Array;
  moved: Uint8Array;
}

/** Samples of a world. Tables over samples and boxes lie sample by sample. */
export interface Series {
  time: Float64Array;
  acceleration: Float32Array;
  energy: Float32Array;
  fallen: Uint32Array;
  displacement: Float32Array;
  orientation: Float32Array;
}

/** The sides of the container in the order of the file. */
export const SIDES = ["floor", "front", "rear", "left", "right", "roof"] as const;

export interface WallForces {
  peak: Float64Array;
  lasting: Float64Array;
  limit: Float64Array;
  /** N, six per sample; empty without series */
  force: Float32Array;
}

/** A layout as the engine takes it. */
export interface LoadedLayout {
  /** first line of the layout file */
  header: string;
  /** rows of seven numbers: corner with the smallest coordinates, corner with the largest (m), material */
  boxes: Float64Array;
}

export interface World {
  index: number;
  layout: string;
  acceleration: string;
  segments: Segment[];
  engine: string;
  status: number;
  statusText: string;
  verdict: number;
  endTime: number;
  boxes: BoxColumns;
  /** null: the file has no series, or the world was not simulated */
  series: Series | null;
  walls: WallForces | null;
  /** 16 hexadecimal digits: of the bits of the state at the end */
  stateHash: string;
  /** null: it is described in another part of the run */
  loaded: LoadedLayout | null;
}
