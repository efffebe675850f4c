import type { Load, LoadBox } from "holdfast-engine";
import { containerOf } from "../data/containers";
import type { Column, FileContents } from "../data/file_contents";
import { STOP_REASON_CODES, VERDICT_CODES, WORLD_FIELDS } from "../data/outcome";
import type { Segment } from "../data/results";
import { FORMAT_VERSION } from "../data/results_datasets";
import { sha256 } from "../data/sha256";
import { KEPT_OF_BOXES, type Screened } from "./screened";
import { type SavedWorld, savedWorlds } from "./world_rows";

/** The results file of a screening, as docs/reference/results_file.md describes that of `holdfast screen --no-series`. */

/** The axes, as attributes name their beginnings: the file is whole, so that all of them begin at 0. */
const AXES = ["worlds", "boxes", "samples", "rows", "layouts", "layout_boxes", "accelerations", "segments"];

export async function resultsContents(screened: Screened): Promise<FileContents> {
  const { results } = screened;
  const { thresholds } = results;
  const worlds = savedWorlds(screened);
  const layouts = [...new Set(worlds.map(({ layout }) => layout))];
  return {
    attributes: {
      "/": {
        format: "holdfast results",
        format_version: BigInt(FORMAT_VERSION),
        software: results.software,
        git_commit: "unknown",
        engine: results.engine,
        command_line: "screened in the page",
        created_utc: results.created,
        host: "a browser",
        // It says what must be the same where a run goes on that was interrupted; none goes on here.
        fingerprint: "",
        ...Object.fromEntries(AXES.map((axis) => [`${axis}_begin`, 0n])),
        complete: 1n,
      },
      "/inputs/settings": results.settings,
      "/summary": {
        drop_threshold: thresholds.drop,
        drop_threshold_units: "m",
        move_threshold: thresholds.move,
        move_threshold_units: "m",
        tilt_threshold: thresholds.tilt,
        tilt_threshold_units: "degree",
      },
    },
    columns: {
      ...layoutColumns(screened, layouts),
      ...(await accelerationColumns(results.accelerations, results.segments)),
      ...worldColumns(worlds),
      ...boxColumns(screened, worlds),
      ...(results.margins ? marginColumns(screened, layouts) : {}),
    },
  };
}

/** Where the entries of each begin, when they lie one after the other. */
function beginsOf(counts: readonly number[]): number[] {
  let begin = 0;
  return counts.map((count) => {
    begin += count;
    return begin - count;
  });
}

/** Nothing is said of it. */
const NONE = Number.NaN;
const NO_PLACE = [NONE, NONE, NONE];

function layoutColumns({ loads }: Screened, layouts: readonly number[]): Record<string, Column> {
  const all = layouts.map((layout) => loads[layout]);
  const boxes = all.flatMap(({ load }) => load.boxes);
  const counts = all.map(({ load }) => load.boxes.length);
  const own = all.map(({ load }) => ownContainer(load));
  const ofBoxes: Record<string, (box: LoadBox) => number | string | readonly number[]> = {
    corner_min: (box) => box.corner_min,
    corner_max: (box) => box.corner_max,
    material: materialNumber,
    material_name: (box) => (typeof box.material === "string" ? box.material : ""),
    box_name: (box) => box.name ?? "",
    mass: (box) => box.mass ?? NONE,
    centre_of_mass: (box) => box.centre_of_mass ?? NO_PLACE,
    mat: (box) => box.mat ?? NONE,
    fixed: (box) => (box.fixed ? 1 : 0),
    order: (box) => box.order ?? NONE,
    bearing_limit: (box) => box.bearing_limit ?? NONE,
  };
  const columns: Record<string, Column> = {
    name: all.map(({ name }) => name),
    sha256: all.map((load) => load.sha256),
    header: all.map(({ header }) => header),
    box_begin: beginsOf(counts),
    box_count: counts,
    container_type: own.map(({ type }) => type),
    container_size: own.flatMap(({ size }) => size),
    open_sides: own.map(({ openSides }) => openSides),
    drop_sides: own.map(({ dropSides }) => dropSides),
    bed_height: own.map(({ bedHeight }) => bedHeight),
    ...Object.fromEntries(Object.entries(ofBoxes).map(([name, value]) => [name, boxes.flatMap(value) as Column])),
  };
  return Object.fromEntries(Object.entries(columns).map(([name, column]) => [`/inputs/layouts/${name}`, column]));
}

/** -1 where it has a name. */
const materialNumber = ({ material }: LoadBox) => (typeof material === "number" ? material : -1);

/** What a load says of a container of its own. */
function ownContainer({ container }: Load) {
  if (!container) return { type: "", size: NO_PLACE, openSides: "", dropSides: "", bedHeight: NONE };
  const { type, size, settings } = containerOf(container);
  const openSides = settings!["Container/OpenSides"];
  return { type, size, openSides, dropSides: settings!["Container/DropSides"], bedHeight: container.bed_height ?? 0 };
}

async function accelerationColumns(
  names: readonly string[],
  segments: readonly (readonly Segment[])[],
): Promise<Record<string, Column>> {
  const all = segments.flat();
  const numbersOf = ({ start, duration, value }: Segment) => [start, duration, ...value];
  const hashes = segments.map((of) => sha256(new Uint8Array(Float64Array.from(of.flatMap(numbersOf)).buffer)));
  const counts = segments.map((of) => of.length);
  return {
    "/inputs/accelerations/name": names,
    "/inputs/accelerations/sha256": await Promise.all(hashes),
    "/inputs/accelerations/segment_begin": beginsOf(counts),
    "/inputs/accelerations/segment_count": counts,
    "/inputs/accelerations/start": all.map(({ start }) => start),
    "/inputs/accelerations/duration": all.map(({ duration }) => duration),
    "/inputs/accelerations/value": all.flatMap(({ value }) => value),
  };
}

const CODES: Readonly<Record<string, Readonly<Record<string, number>>>> = {
  verdict: VERDICT_CODES,
  stop_reason: STOP_REASON_CODES,
};

function worldColumns(worlds: readonly SavedWorld[]): Record<string, Column> {
  const columns = WORLD_FIELDS.map(({ name, type, dataset }) => {
    const values = worlds.map(({ row }) => row[name]);
    const codes = CODES[type];
    if (codes) return [dataset, values.map((value) => codes[value])];
    return [dataset, type === "hash" ? values.map((value) => BigInt(`0x${value}`)) : values];
  });
  return Object.fromEntries(columns);
}

function boxColumns({ loads, worlds: kept }: Screened, worlds: readonly SavedWorld[]): Record<string, Column> {
  const simulated = worlds.flatMap(({ world, layout }, index) => {
    const of = kept[world];
    return of ? [{ index, of, boxes: loads[layout].load.boxes }] : [];
  });
  return {
    "/boxes/world": simulated.flatMap(({ index, boxes }) => boxes.map(() => index)),
    "/boxes/id": simulated.flatMap(({ boxes }) => boxes.map((_, box) => box + 1)),
    "/boxes/material": simulated.flatMap(({ boxes }) => boxes.map(materialNumber)),
    ...Object.fromEntries(
      KEPT_OF_BOXES.map((dataset) => [dataset, joined(simulated.map(({ of }) => of.boxes.get(dataset)!))]),
    ),
  };
}

function joined(parts: readonly Float32Array[]): Float32Array {
  const begins = beginsOf(parts.map((part) => part.length));
  const all = new Float32Array(parts.reduce((sum, part) => sum + part.length, 0));
  for (const [index, part] of parts.entries()) all.set(part, begins[index]);
  return all;
}

function marginColumns({ results, margins }: Screened, layouts: readonly number[]): Record<string, Column> {
  const { inPlace, withinLimits } = results.margins!;
  const ofLayouts = (values: ArrayLike<number>) =>
    layouts.flatMap((layout) => Array.from({ length: 4 }, (_, side) => values[4 * layout + side]));
  return {
    "/margins/margin": ofLayouts(inPlace.margin),
    "/margins/critical_box": ofLayouts(inPlace.criticalBox),
    "/margins/margin_within_limits": ofLayouts(withinLimits!.margin),
    "/margins/critical_box_within_limits": ofLayouts(withinLimits!.criticalBox),
    "/margins/trials": layouts.map((layout) => margins[layout]?.columns.trials[0] ?? 0),
    "/margins/cpu_seconds": layouts.map((layout) => margins[layout]?.seconds ?? 0),
  };
}
