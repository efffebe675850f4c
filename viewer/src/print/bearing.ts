import type { LoadBox } from "holdfast-engine";
import type { BoxColumns, Results, World } from "../data/results";
import { EngineClient, engineCarried } from "../engine/engine_client";
import { engineSettings } from "../live/saved_files";
import { boundsOfBox, shortName } from "./packed_load";
import { bad, besideLimit, type Cell, moreBoxes, part, table, weight } from "./tables";

/** What rests on boxes with a limit, as `holdfast check --bearing` finds it. */

/** kg above a limit that count as within it */
const WITHIN_LIMIT = 1e-3;

/** A box with a limit, and the least and the largest load on it that statics admits, kg; NaN: not known. */
export interface LimitedBox {
  box: number;
  loads: [least: number, largest: number];
}

type Triple = [number, number, number];

/** A box as the engine reads it. Where nothing else is said, the centre of mass is in its middle. */
function boxOf(world: World, box: number): LoadBox {
  const { boxes } = world;
  const { low, high } = boundsOfBox(world, box);
  const offset = low.map((least, axis) => boxes.initial[3 * box + axis] - (least + high[axis]) / 2);
  const isApart = offset.some((part) => Math.abs(part) > 1e-5);
  return {
    corner_min: [...low] as Triple,
    corner_max: [...high] as Triple,
    material: 1,
    ...(boxes.fixed[box] ? { fixed: true } : { mass: boxes.mass[box] }),
    ...(isApart ? { centre_of_mass: offset as Triple } : {}),
  };
}

/** The boxes of a world that have a limit, the nearest to it first; none where the page has no engine to find what rests on them. */
export async function findBearing(results: Results, world: World): Promise<LimitedBox[]> {
  const { boxes, loaded } = world;
  const limited = [...boxes.id.keys()].filter((box) => Number.isFinite(boxes.bearingLimit[box]));
  if (limited.length === 0 || !loaded || !engineCarried()) return [];
  const client = await EngineClient.start();
  try {
    const load = { name: world.layout, boxes: Array.from(boxes.id, (_, box) => boxOf(world, box)) };
    const settings = { settings: engineSettings({ ...results.settings, ...loaded.settings }, {}) };
    const { least, largest } = await client.ask("bearing", { load, settings });
    const share = ({ box, loads }: LimitedBox) =>
      Number.isNaN(loads[1]) ? Number.POSITIVE_INFINITY : loads[1] / Math.max(boxes.bearingLimit[box], WITHIN_LIMIT);
    return limited
      .map((box): LimitedBox => ({ box, loads: [least[box], largest[box]] }))
      .sort((a, b) => share(b) - share(a) || a.box - b.box);
  } finally {
    client.close();
  }
}

export function bearingTable(boxes: BoxColumns, limited: readonly LimitedBox[], most: number): HTMLElement | null {
  if (limited.length === 0) return null;
  const rows = limited.slice(0, most).map(({ box, loads }): Cell[] => {
    const limit = boxes.bearingLimit[box];
    const cells = loads.map((load) => {
      const text = weight(load) === weight(limit) ? besideLimit(load, limit) : weight(load);
      return load > limit + WITHIN_LIMIT ? bad(text) : text;
    });
    return [String(boxes.id[box]), shortName(boxes.name[box]), ...cells, weight(limit)];
  });
  return part(
    "What rests on boxes with a limit, by gravity alone",
    table(
      [
        { head: "box" },
        { head: "name", kind: "text name" },
        { head: "least, kg" },
        { head: "largest, kg" },
        { head: "may bear, kg" },
      ],
      rows,
    ),
    moreBoxes(limited.length - rows.length),
  );
}
