import type { Hdf5File, Numbers } from "./hdf5_file";
import { centimetres } from "./lengths";
import { readOpenings } from "./openings";
import type { BoxColumns, Container, LoadedLayout, Results, Size } from "./results";

export const OWN_CENTRES = "centres of mass of its own";

/** m: an offset of a centre of mass that is more than rounding. */
const OFFSET = 1e-4;

type OfLoad = Pick<BoxColumns, "name" | "material" | "mat" | "bearingLimit" | "fixed">;

/** What loads say of their boxes. Files of earlier versions have less of it. */
export class LoadInputs {
  /** @param begin first box of the layouts that the file has */
  constructor(
    private readonly file: Hdf5File,
    private readonly results: Results,
    private readonly begin: number,
  ) {}

  /** The rows of a layout's boxes; null: it is described in another part of the run, or could not be used. */
  private rows(layout: number): [number, number] | null {
    const { layouts, layoutBoxes } = this.results;
    if (layout < 0 || layout >= layouts.length || layoutBoxes[layout] === 0) return null;
    const first = this.file.numbers("inputs/layouts/box_begin", layout, layout + 1)[0] - this.begin;
    return [first, first + layoutBoxes[layout]];
  }

  private numbers(name: string, [begin, end]: [number, number]): Numbers | null {
    const path = `inputs/layouts/${name}`;
    return this.file.has(path) ? this.file.numbers(path, begin, end) : null;
  }

  private texts(name: string, [begin, end]: [number, number]): string[] | null {
    const path = `inputs/layouts/${name}`;
    return this.file.has(path) && end > begin ? this.file.texts(path, begin, end) : null;
  }

  names(layout: number): string[] {
    const rows = this.rows(layout);
    return (rows && this.texts("box_name", rows)) ?? [];
  }

  /** @param ids numbers of the materials, -1 where they have names */
  boxes(layout: number, ids: Numbers): OfLoad {
    const rows = ids.length > 0 ? this.rows(layout) : null;
    const none = () => new Float64Array(ids.length).fill(Number.NaN);
    const numbers = (name: string) => (rows && this.numbers(name, rows)) ?? none();
    const texts = (name: string) => (rows && this.texts(name, rows)) ?? Array<string>(ids.length).fill("");
    const materials = texts("material_name");
    return {
      name: texts("box_name"),
      material: materials.map((name, box) => (name === "" ? String(ids[box]) : name)),
      mat: Float64Array.from(numbers("mat")),
      bearingLimit: Float64Array.from(numbers("bearing_limit")),
      fixed: Uint8Array.from(numbers("fixed"), (flag) => (flag > 0 ? 1 : 0)),
    };
  }

  /** A layout as the engine takes it, and what is more in it. */
  layout(layout: number, boxes: BoxColumns): LoadedLayout | null {
    const rows = this.rows(layout);
    if (!rows) return null;
    const count = rows[1] - rows[0];
    const lower = this.file.numbers("inputs/layouts/corner_min", ...rows);
    const upper = this.file.numbers("inputs/layouts/corner_max", ...rows);
    const material = this.file.numbers("inputs/layouts/material", ...rows);
    const all = new Float64Array(7 * count);
    for (let box = 0; box < count; ++box)
      all.set([...lower.slice(3 * box, 3 * box + 3), ...upper.slice(3 * box, 3 * box + 3), material[box]], 7 * box);
    const header = this.file.texts("inputs/layouts/header", layout, layout + 1)[0];
    const more = this.more(layout, rows, boxes, all);
    const known = (name: string) => {
      const values = this.numbers(name, rows);
      return values?.some(Number.isFinite) ? Float64Array.from(values) : null;
    };
    const fixed = this.numbers("fixed", rows);
    const settings = {
      ...numbered(all, boxes.material, (box) => (fixed?.[box] ?? 0) > 0, this.results.settings),
      ...this.results.ownContainers.get(layout)?.settings,
    };
    const missing = more.filter((words) => words === OWN_CENTRES);
    return { header, boxes: all, masses: known("mass"), mats: known("mat"), settings, more, missing };
  }

  /** What a load says that rows of seven numbers do not have, in words. */
  private more(layout: number, rows: [number, number], boxes: BoxColumns, all: Float64Array): string[] {
    const some = (name: string, is: (value: number) => boolean) => (this.numbers(name, rows) ?? []).some(is);
    const material = (box: number) => `Material ${boxes.material[box]}`;
    const { settings } = this.results;
    const offset = boxes.initial.some((place, i) => {
      const [box, axis] = [Math.floor(i / 3), i % 3];
      const given = Number((settings[`${material(box)}/CentreOfMass`] ?? "").split(/\s+/)[axis] ?? 0) / 100;
      return Math.abs(place - (all[7 * box + axis] + all[7 * box + 3 + axis]) / 2 - (given || 0)) > OFFSET;
    });
    const found: [boolean, string][] = [
      [this.results.ownContainers.has(layout), "a container of its own"],
      [some("mass", Number.isFinite), "masses of its own"],
      [(this.texts("material_name", rows) ?? []).some((name) => name !== ""), "materials with names"],
      [some("mat", Number.isFinite), "anti-slip mats"],
      [some("fixed", (flag) => flag > 0), "fixed boxes of its own"],
      [offset, OWN_CENTRES],
    ];
    return found.filter(([is]) => is).map(([, words]) => words);
  }
}

/**
 * Gives numbers to materials with names, and to fixed boxes, in the rows of a layout, and the settings of these numbers. Those of
 * the names stay: no box has them.
 */
export function numbered(
  rows: Float64Array,
  materials: readonly string[],
  fixed: (box: number) => boolean,
  settings: Readonly<Record<string, string>>,
): Record<string, string> {
  const numbers = new Map<string, { number: number; name: string; fixed: boolean }>();
  let next = Math.max(0, ...materials.map(Number).filter(Number.isFinite)) + 1;
  for (const [box, name] of materials.entries()) {
    if (rows[7 * box + 6] >= 0 && !fixed(box)) continue;
    const key = `${name}/${fixed(box)}`;
    const known = numbers.get(key) ?? { number: next++, name, fixed: fixed(box) };
    numbers.set(key, known);
    rows[7 * box + 6] = known.number;
  }
  const made: Record<string, string> = {};
  const all = [...numbers.values()];
  /** the names of a material in the rows of the engine */
  const namesOf = (name: string) => [
    name,
    ...all.filter((one) => one.name === name).map(({ number }) => String(number)),
  ];
  for (const [key, value] of Object.entries(settings)) {
    const material = /^Material (.+)\/(\w+)$/.exec(key);
    if (material)
      for (const { number, name } of all) if (name === material[1]) made[`Material ${number}/${material[2]}`] = value;
    const pair = /^Friction\/(.+), (.+)$/.exec(key);
    if (!pair) continue;
    for (const a of namesOf(pair[1]))
      for (const b of namesOf(pair[2])) if (a !== pair[1] || b !== pair[2]) made[`Friction/${a}, ${b}`] = value;
  }
  for (const { number, fixed: part } of all) if (part) made[`Material ${number}/Fixed`] = "true";
  return made;
}

/**
 * The container that a load has of its own.
 * @param open names of sides, and `low` with the height of each in cm, as the keys of [Container] take them
 * @param bedHeight m
 */
export function ownContainer(type: string, size: Size, open: string, low: string, bedHeight: number): Container {
  const [length, width, height] = size;
  const sides = { "Container/OpenSides": open, "Container/DropSides": low };
  const lengths = {
    "Container/Length": length,
    "Container/Width": width,
    "Container/Height": height,
    "Container/BedHeight": bedHeight,
  };
  const given = Object.fromEntries(Object.entries(lengths).map(([key, value]) => [key, centimetres(value)]));
  const settings: Record<string, string> = { ...sides, ...given, "Container/Type": "" };
  return { type, size, openings: readOpenings(settings, height), settings };
}

/** The container of the run, and those of layouts that have their own. */
export function readContainers(
  file: Hdf5File,
  settings: Readonly<Record<string, string>>,
): Pick<Results, "container" | "ownContainers"> {
  const metres = (key: string) => Number(settings[`Container/${key}`]) / 100;
  const size: Size = [metres("Length"), metres("Width"), metres("Height")];
  const container = { type: settings["Container/Type"] ?? "", size, openings: readOpenings(settings, size[2]) };
  const ownContainers = new Map<number, Container>();
  const sizes = file.has("inputs/layouts/container_size") ? file.numbers("inputs/layouts/container_size") : [];
  if (!sizes.some(Number.isFinite)) return { container, ownContainers };
  const [types, open, low] = ["container_type", "open_sides", "drop_sides"].map((name) =>
    file.texts(`inputs/layouts/${name}`),
  );
  const beds = file.numbers("inputs/layouts/bed_height");
  for (let layout = 0; layout < beds.length; ++layout) {
    const size = [...sizes.slice(3 * layout, 3 * layout + 3)] as Size;
    if (!size.every(Number.isFinite)) continue;
    const own = ownContainer(types[layout], size, open[layout], low[layout], beds[layout]);
    ownContainers.set(layout, own);
  }
  return { container, ownContainers };
}
