import type { Load, RunSettings } from "holdfast-engine";
import type { EnginePool } from "./engine_pool";
import type { FoundMargins } from "./messages";

const DIRECTIONS = [0, 1, 2, 3];

/** The margins of a load; each direction is searched by an engine of its own, where there are as many. */
export async function askMargins(
  pool: EnginePool,
  load: Load,
  settings: RunSettings,
  isUrgent = false,
): Promise<FoundMargins> {
  const found = await Promise.all(
    DIRECTIONS.map((direction) => pool.ask("margins", { load, settings, direction }, isUrgent)),
  );
  const sum = (of: (one: FoundMargins) => number) => found.reduce((all, one) => all + of(one), 0);
  const columns = Object.fromEntries(
    Object.keys(found[0].columns).map((name) => [name, Float64Array.from(found, ({ columns }, at) => columns[name][at])]),
  );
  columns.trials = Float64Array.of(sum(({ columns }) => columns.trials[0]));
  return { columns, seconds: sum(({ seconds }) => seconds) };
}
