/** What the page knows of a results file: plain columns, in the units and frame of docs/reference/results_file.md. */

import type { Load, Shape } from "holdfast-engine";
import type { Openings } from "./openings";

/** Number of boxes of a world that was not simulated, or that a file of an earlier version does not have. */
export const NOT_COUNTED = 0xffffffff;

/** In place of the code of a verdict, while a world is not simulated yet. */
export const PENDING = 0xff;

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

/** One entry per world of the file. Counts are of boxes that were ever so; at the end in a file of an earlier version. */
export interface WorldColumns {
  layout: Uint32Array;
  acceleration: Uint32Array;
  status: Uint32Array;
  /** s: peaks are up to here; NaN where the status is 0 */
  statusTime: Float64Array;
  caveats: Uint32Array;
  stopReason: Uint8Array;
  verdict: Uint8Array;
  boxes: Uint32Array;
  samples: Uint32Array;
  fallen: Uint32Array;
  unstable: Uint32Array;
  moved: Uint32Array;
  tilted: Uint32Array;
  fallenAtEnd: Uint32Array;
  /** from 1; 0: no box has used up 1 % of a limit */
  criticalBox: Uint32Array;
  /** m, over all steps */
  peakDisplacement: Float32Array;
  /** m, over all steps */
  peakDrop: Float32Array;
  /** degree, over all steps */
  peakTilt: Float32Array;
  /** m */
  endDisplacement: Float32Array;
  /** J */
  peakEnergy: Float64Array;
  endTime: Float64Array;
  cpuSeconds: Float64Array;
  /** Rows of the file at which the world's entries begin. */
  boxBegin: Float64Array;
  sampleBegin: Float64Array;
  rowBegin: Float64Array;
}

/** Columns of so many worlds of which nothing is known yet. */
export function emptyWorlds(count: number): WorldColumns {
  const none = () => new Uint32Array(count);
  return {
    layout: none(),
    acceleration: none(),
    status: none(),
    statusTime: new Float64Array(count).fill(Number.NaN),
    caveats: none(),
    stopReason: new Uint8Array(count),
    verdict: new Uint8Array(count),
    boxes: none(),
    samples: none(),
    fallen: none(),
    unstable: none(),
    moved: none(),
    tilted: none(),
    fallenAtEnd: none(),
    criticalBox: none(),
    peakDisplacement: new Float32Array(count),
    peakDrop: new Float32Array(count),
    peakTilt: new Float32Array(count),
    endDisplacement: new Float32Array(count),
    peakEnergy: new Float64Array(count),
    endTime: new Float64Array(count),
    cpuSeconds: new Float64Array(count),
    boxBegin: new Float64Array(count),
    sampleBegin: new Float64Array(count),
    rowBegin: new Float64Array(count),
  };
}

/** Four per layout: front, rear, left, right. */
export interface MarginColumns {
  /** g */
  margin: Float64Array;
  /** from 1; 0: none up to the largest acceleration that is tried */
  criticalBox: Uint32Array;
}

export interface Margins {
  /** every box stays within 5 mm of its place */
  inPlace: MarginColumns;
  /** every box stays within the limits of the verdict; null in a file of an earlier version */
  withinLimits: MarginColumns | null;
}

export interface Replicas {
  count: Uint32Array;
  failed: Uint32Array;
  share: Float64Array;
  low: Float64Array;
  high: Float64Array;
}

/** How many boxes of each world were struck beyond the damage boundary; `NOT_COUNTED` in one that was not accelerated. */
export interface Damage {
  boxesBeyond: Uint32Array;
  /** g, and m/s: a box is beyond the boundary where both are exceeded */
  boundary: { acceleration: number; velocityChange: number };
}

/** The side of each world that is pressed hardest, of those that stand up. */
export interface HardestWalls {
  /** N, over 0.05 s; NaN in a world that was not accelerated */
  force: Float64Array;
  /** of the limit of the run's norm, the largest; NaN where there is none */
  share: Float64Array;
  /** N, the largest of all worlds */
  most: number;
  /** the norm that the limits are of; empty: none */
  norm: string;
}

/** m: length, width, height */
export type Size = [number, number, number];

/** What boxes stand in. */
export interface Container {
  /** name in the program's catalogue; empty: none of them */
  type: string;
  size: Size;
  openings: Openings;
  /** where it is that of a load: as JSON of ours has it, and as keys of [Container] */
  shape?: Shape;
  settings?: Record<string, string>;
}

/** The summary of a file: everything but boxes and series. */
export interface Results {
  name: string;
  /** bytes of the file; null: it is of this page */
  size: number | null;
  complete: boolean;
  firstWorld: number;
  engine: string;
  software: string;
  created: string;
  settings: Record<string, string>;
  thresholds: Thresholds;
  /** The file is of an earlier version: worlds are judged by where boxes are at the end, not by all that they did. */
  judgedAtEnd: boolean;
  /** that of the run */
  container: Container;
  /** containers of layouts that have their own */
  ownContainers: Map<number, Container>;
  layouts: string[];
  layoutBoxes: Uint32Array;
  accelerations: string[];
  segments: Segment[][];
  worlds: WorldColumns;
  hasSeries: boolean;
  hasWalls: boolean;
  margins: Margins | null;
  replicas: Replicas | null;
  /** where the run has recorded them */
  damage?: Damage;
  hardestWalls?: HardestWalls;
}

/** How far boxes are from their reference poses: what the limits are compared with. */
export interface Excursions {
  /** m, length */
  displacement: Float32Array;
  /** m, by how much the centre of mass is lower; never negative */
  drop: Float32Array;
  /** degree */
  tilt: Float32Array;
}

/** One entry per box, in the order of the layout file; tables of three lie one after the other. */
export interface BoxColumns {
  id: Uint32Array;
  /** empty: it has none */
  name: string[];
  /** a number or a name */
  material: string[];
  /** coefficient of friction of the anti-slip mat beneath it; NaN: there is none */
  mat: Float64Array;
  /** kg, most that may rest on it; NaN: not known */
  bearingLimit: Float64Array;
  mass: Float32Array;
  /** part of the container: it never moves, and counts in no verdict */
  fixed: Uint8Array;
  size: Float32Array;
  /** m, from the middle of the box to its centre of mass, along its axes */
  centre: Float32Array;
  /** m, of the centre of mass as loaded */
  initial: Float32Array;
  /** m, from where displacement counts: as settled, at t = 0, or as loaded */
  reference: Float32Array;
  endDisplacement: Float32Array;
  end: Excursions;
  /** over all steps; drop and tilt are NaN in a file of an earlier version */
  peak: Excursions;
  /** while the load settles, before t = 0; at its end in a file of an earlier version */
  settling: Excursions;
  /** what the verdict is from: `peak`, or `end` in a file of an earlier version */
  judged: Excursions;
  peakEnergy: Float32Array;
  /** s, when the box was beyond a limit first, negative while settling; NaN: never, or not known */
  firstBeyond: Float32Array;
  fallen: Uint8Array;
  moved: Uint8Array;
  tilted: Uint8Array;
  unstable: Uint8Array;
  /** where the run has recorded it, and the world was accelerated */
  damage?: BoxDamage;
}

/** How hard each box was struck: its largest acceleration (m/s²), and change of velocity in an impact (m/s). */
export interface BoxDamage {
  acceleration: Float32Array;
  velocityChange: Float32Array;
  beyond: Uint8Array;
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

/** What boxes press, in the order of the file; one of an earlier version ends with the roof. */
export const PRESSED = ["floor", "front", "rear", "left", "right", "roof", "ground", "fixed boxes"] as const;

export interface WallForces {
  peak: Float64Array;
  lasting: Float64Array;
  limit: Float64Array;
  /** N, as many per sample as the others have entries; empty without series */
  force: Float32Array;
}

/** A layout as the engine takes it. */
export interface LoadedLayout {
  /** all that it says */
  load: Load;
  /** rows of seven numbers: corner with the smallest coordinates, corner with the largest (m), material */
  boxes: Float64Array;
  /** kg, and coefficients of friction, one per box, NaN where it has none; null: none has */
  masses: Float64Array | null;
  mats: Float64Array | null;
  /** in place of those of the run: numbers for materials, and the load's own container */
  settings: Record<string, string>;
}

export interface World {
  index: number;
  layout: string;
  container: Container;
  acceleration: string;
  segments: Segment[];
  engine: string;
  status: number;
  statusText: string;
  verdict: number;
  stopReason: number;
  /** False: it ended while it settled, before t = 0. */
  accelerated: boolean;
  /** from 1; 0: no box has used up 1 % of a limit */
  criticalBox: number;
  /** s: 0, or earlier where only settling is recorded */
  beginTime: number;
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
