import { causes } from "../data/status";
import { notSimulated } from "../screen/not_simulated";
import { type Screened, wholeLoads } from "./screened";

/** A world by the names of `WORLD_FIELDS`: codes by their names, the hash in hexadecimal. */
export type WorldRow = Readonly<Record<string, number | string>>;

/** A world of the file: its row, the world of the screening that it is, and its load. */
export interface SavedWorld {
  row: WorldRow;
  world: number;
  layout: number;
}

/** What the program says where several things are wrong. */
function messageOf(errors: Screened["loads"][number]["errors"]): string {
  const more = errors.length - 1;
  return errors[0].message + (more > 0 ? ` (and ${more} more)` : "");
}

const sentencesOf = (status: number) =>
  causes(status)
    .map(({ meaning }) => meaning)
    .join(" ");

/**
 * The worlds of all loads that can be told of whole, in the order of the screening. Boxes of a world come after those
 * of the worlds before it. Samples are not saved.
 */
export function savedWorlds(screened: Screened): SavedWorld[] {
  const { results, loads, worlds } = screened;
  const layouts = wholeLoads(screened);
  let boxBegin = 0;
  return layouts.flatMap((layout, index) =>
    results.accelerations.map((_, acceleration) => {
      const world = layout * results.accelerations.length + acceleration;
      const kept = worlds[world];
      const found: WorldRow = kept
        ? { ...kept.outcome, peakTotalKineticEnergy: kept.outcome.peakKineticEnergy, cpuSeconds: kept.seconds }
        : { ...notSimulated(), peakTotalKineticEnergy: 0 };
      const message = kept ? sentencesOf(kept.outcome.status) : messageOf(loads[layout].errors);
      const places = { boxBegin, sampleBegin: 0, sampleCount: 0, rowBegin: 0 };
      const solveIterations = kept?.solveIterations ?? 0;
      const stored = { ...places, solveIterations, layout: index, acceleration, message, engine: results.engine };
      const row: WorldRow = { ...found, ...stored };
      boxBegin += Number(row.boxes);
      return { row, world, layout };
    }),
  );
}
