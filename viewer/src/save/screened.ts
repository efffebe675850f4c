import type { WorldOutcome } from "holdfast-engine";
import { BOX_FIELDS, BOX_VERDICT_FIELDS } from "../data/outcome";
import type { Results } from "../data/results";
import type { FoundMargins, HashedLoad, SimulatedWorld } from "../engine/messages";

/** What is kept of a world that was simulated. */
export interface KeptWorld {
  outcome: WorldOutcome;
  /** one entry per box, by the dataset of the results file */
  boxes: ReadonlyMap<string, Float32Array>;
  solveIterations: number;
  /** that the engine took */
  seconds: number;
}

/** All that files of a screening are made of. */
export interface Screened {
  results: Results;
  loads: readonly HashedLoad[];
  /** by world; null: it is not simulated */
  worlds: readonly (KeptWorld | null)[];
  /** by layout; null: they are not found */
  margins: readonly (FoundMargins | null)[];
}

/** The columns that the engine gives of boxes, by their datasets: the judgement has a folder of its own there. */
const BOX_COLUMNS = new Map([
  ...["/boxes/mass", "/boxes/size", "/boxes/initial_position", ...BOX_FIELDS.map(({ dataset }) => dataset)].map(
    (dataset) => [dataset, dataset.slice(1)] as const,
  ),
  ...BOX_VERDICT_FIELDS.map(({ dataset }) => [dataset, dataset.replace("/summary/boxes/", "verdict/")] as const),
]);

/** The datasets that are kept of boxes. */
export const KEPT_OF_BOXES: readonly string[] = [...BOX_COLUMNS.keys()];

/** A world without its samples, which are many. */
export function keptOf({ outcome, columns, seconds }: SimulatedWorld): KeptWorld {
  const boxes = new Map([...BOX_COLUMNS].map(([dataset, name]) => [dataset, Float32Array.from(columns[name])]));
  return { outcome, boxes, solveIterations: columns["worlds/solve_iterations"][0], seconds };
}

/** The loads that can be told of whole: all of their worlds are simulated, or they cannot be used. */
export function wholeLoads({ results, loads, worlds }: Screened): number[] {
  const missing = new Set(results.worlds.layout.filter((_, world) => worlds[world] === null));
  return [...loads.keys()].filter((layout) => loads[layout].errors.length > 0 || !missing.has(layout));
}
