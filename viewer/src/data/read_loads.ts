import type { Load, LoadBox } from "holdfast-engine";
import { centreOfMass } from "./centre_of_mass";
import type { Hdf5File, Numbers } from "./hdf5_file";
import { loadedLayout } from "./loaded_layout";
import type { BoxColumns, LoadedLayout, Results } from "./results";

type OfLoad = Pick<BoxColumns, "name" | "material" | "mat" | "bearingLimit" | "fixed" | "centre">;

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
    const material = texts("material_name").map((name, box) => (name === "" ? String(ids[box]) : name));
    const centres = (rows && this.numbers("centre_of_mass", rows)) ?? [];
    return {
      name: texts("box_name"),
      material,
      mat: Float64Array.from(numbers("mat")),
      bearingLimit: Float64Array.from(numbers("bearing_limit")),
      fixed: Uint8Array.from(numbers("fixed"), (flag) => (flag > 0 ? 1 : 0)),
      centre: Float32Array.from(
        material.flatMap((name, box) => centreOfMass(centres.slice(3 * box, 3 * box + 3), name, this.results.settings)),
      ),
    };
  }

  /** A layout as the engine takes it. */
  layout(layout: number, { material }: Pick<BoxColumns, "material">): LoadedLayout | null {
    const rows = this.rows(layout);
    if (!rows) return null;
    const corner = (name: string) => {
      const all = this.file.numbers(`inputs/layouts/${name}`, ...rows);
      return (box: number) => [...all.slice(3 * box, 3 * box + 3)] as LoadBox["corner_min"];
    };
    const numbers = (name: string) => {
      const all = this.numbers(name, rows);
      return (box: number) => (all && Number.isFinite(all[box]) ? all[box] : undefined);
    };
    const ids = this.file.numbers("inputs/layouts/material", ...rows);
    const [low, high] = [corner("corner_min"), corner("corner_max")];
    const [mass, mat, order, limit] = ["mass", "mat", "order", "bearing_limit"].map(numbers);
    const centres = this.numbers("centre_of_mass", rows) ?? [];
    const fixed = this.numbers("fixed", rows) ?? [];
    const names = this.texts("box_name", rows) ?? [];
    const boxes = Array.from(ids, (id, box): LoadBox => {
      const centre = centres.slice(3 * box, 3 * box + 3);
      return {
        corner_min: low(box),
        corner_max: high(box),
        name: names[box] || undefined,
        material: id >= 0 ? id : material[box],
        mass: mass(box),
        centre_of_mass: Number.isFinite(centre[0]) ? ([...centre] as LoadBox["corner_min"]) : undefined,
        mat: mat(box),
        fixed: fixed[box] > 0 || undefined,
        order: order(box),
        bearing_limit: limit(box),
      };
    });
    const own = this.results.ownContainers.get(layout);
    const load: Load = { name: this.results.layouts[layout], container: own?.shape, boxes };
    return loadedLayout(load, this.results.settings, own);
  }
}
