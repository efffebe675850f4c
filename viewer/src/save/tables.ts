import {
  BOX_FIELDS,
  BOX_VERDICT_FIELDS,
  CAVEAT_BITS,
  type OutcomeField,
  STATUS_BITS,
  WORLD_FIELDS,
} from "../data/outcome";
import { NOT_COUNTED } from "../data/results";
import { DIRECTIONS } from "../fleet/rows";
import { csvBits, csvContainer, csvNumber, csvText } from "./csv_field";
import { type Screened, wholeLoads } from "./screened";
import { savedWorlds } from "./world_rows";

/** The tables of a screening, with the headings and the cells that `holdfast summary --csv` gives them. */

const BREAK = "\r\n";
const AXES = ["x", "y", "z"];

/** Hashes are left out: spreadsheets take them for numbers. */
const shown = (fields: readonly OutcomeField[]) => fields.filter(({ label, type }) => label !== "" && type !== "hash");

const WORLD_COLUMNS = shown(WORLD_FIELDS);
const BOX_COLUMNS = shown([...BOX_VERDICT_FIELDS, ...BOX_FIELDS]);

/** Of a vector three: `end_displacement_x_m` and so on. */
function headings({ label, type }: OutcomeField): string[] {
  if (type !== "vec3") return [label];
  const unit = label.lastIndexOf("_");
  return AXES.map((axis) => `${label.slice(0, unit)}_${axis}${label.slice(unit)}`);
}

function worldCell({ type }: OutcomeField, value: number | string): string {
  if (typeof value === "string") return csvText(value);
  if (type === "status") return csvBits(STATUS_BITS, value) || "ok";
  if (type === "caveat") return csvBits(CAVEAT_BITS, value);
  if (type === "u32" && value === NOT_COUNTED) return "";
  return csvNumber(value, type === "f32");
}

/** A line per world. */
export function worldsCsv(screened: Screened): string {
  const { results, loads } = screened;
  const isCritical = ({ label }: OutcomeField) => label === "critical_box";
  const head = WORLD_COLUMNS.flatMap((field) => [field.label, ...(isCritical(field) ? ["critical_box_name"] : [])]);
  const lines = savedWorlds(screened).map(({ row, layout }, index) => {
    const nameOf = (box: number) => csvText(loads[layout].load.boxes[box - 1]?.name ?? "");
    const cells = WORLD_COLUMNS.flatMap((field) => {
      const value = row[field.name];
      return [worldCell(field, value), ...(isCritical(field) ? [nameOf(Number(value))] : [])];
    });
    const container = csvContainer(results.ownContainers.get(layout));
    return [index, ...inputs(screened, layout, row.acceleration), container, ...cells].join(",");
  });
  return `${[`world,layout,acceleration,container,${head.join(",")}`, ...lines].join(BREAK)}${BREAK}`;
}

/** A line per box of each world. */
export function boxesCsv(screened: Screened): string {
  const { loads, worlds } = screened;
  const head = BOX_COLUMNS.flatMap(headings);
  const lines = savedWorlds(screened).flatMap(({ row, world, layout }, index) => {
    const kept = worlds[world];
    if (!kept) return [];
    const begin = [index, ...inputs(screened, layout, row.acceleration)];
    const columns = BOX_COLUMNS.map(
      ({ dataset, type }) => [kept.boxes.get(dataset)!, type === "vec3" ? 3 : 1] as const,
    );
    const masses = kept.boxes.get("/boxes/mass")!;
    return loads[layout].load.boxes.map(({ name, material }, box) => {
      const said = [csvText(name ?? ""), csvText(String(material)), csvNumber(masses[box], true)];
      const cells = columns.flatMap(([values, width]) =>
        Array.from(values.subarray(width * box, width * (box + 1)), (value) => csvNumber(value, true)),
      );
      return [...begin, box + 1, ...said, ...cells].join(",");
    });
  });
  return `${[`world,layout,acceleration,id,name,material,mass_kg,${head.join(",")}`, ...lines].join(BREAK)}${BREAK}`;
}

const MARGIN_COLUMNS = ["margin_g", "critical_box", "margin_within_limits_g", "critical_box_within_limits"];

/** A line per layout and direction. */
export function marginsCsv(screened: Screened): string {
  const { layouts, margins } = screened.results;
  if (!margins?.withinLimits) throw new Error("No margins were asked for.");
  const both = [margins.inPlace, margins.withinLimits];
  const lines = wholeLoads(screened).flatMap((layout) =>
    DIRECTIONS.map((direction, side) => {
      const at = 4 * layout + side;
      const cells = both.flatMap(({ margin, criticalBox }) => [csvNumber(margin[at], false), criticalBox[at]]);
      return [csvText(layouts[layout]), direction, ...cells].join(",");
    }),
  );
  return `${[`layout,direction,${MARGIN_COLUMNS.join(",")}`, ...lines].join(BREAK)}${BREAK}`;
}

/** Names of what a world is of. */
const inputs = ({ results }: Screened, layout: number, acceleration: number | string) => [
  csvText(results.layouts[layout]),
  csvText(results.accelerations[Number(acceleration)]),
];
