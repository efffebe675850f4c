/** Put in when the page is built, from docs/reference/results_file.md. */
declare const HOLDFAST_RESULTS_DATASETS: readonly Dataset[];

/**
 * What an entry belongs to: a world, a box, a sample, a sample and a box, a layout, a box of a layout, an acceleration, or a
 * segment of one.
 */
export type Axis = "W" | "N" | "S" | "R" | "L" | "B" | "A" | "G";

/** A dataset of the results file, as its reference describes it. */
export interface Dataset {
  path: string;
  type: "uint8" | "uint32" | "uint64" | "int32" | "float32" | "float64" | "text";
  axis: Axis;
  /** numbers per entry */
  width: number;
  units: string;
  description: string;
  /** it is there where a run was asked for it */
  asked: boolean;
}

/** All of them. */
export const RESULTS_DATASETS = HOLDFAST_RESULTS_DATASETS;

/** Version of the file that they are of. */
export const FORMAT_VERSION = 3;

/** Bytes of each text of an axis whose length grows with the number of boxes. */
export const LABEL_BYTES = 120;
