import type { Shape } from "holdfast-engine";
import type { Hdf5File } from "./hdf5_file";
import { centimetres } from "./lengths";
import { readOpenings } from "./openings";
import type { Container, Results, Size } from "./results";

/** A container as the engine describes it. */
export function containerOf(shape: Shape): Container {
  const [length, width, height] = shape.size;
  const lengths = {
    "Container/Length": length,
    "Container/Width": width,
    "Container/Height": height,
    "Container/BedHeight": shape.bed_height ?? 0,
  };
  const low = Object.entries(shape.drop_sides ?? {}).map(([side, wall]) => `${side} ${centimetres(wall)}`);
  const settings: Record<string, string> = {
    "Container/OpenSides": (shape.open_sides ?? []).join(" "),
    "Container/DropSides": low.join(" "),
    ...Object.fromEntries(Object.entries(lengths).map(([key, value]) => [key, centimetres(value)])),
    "Container/Type": "",
  };
  return { type: shape.type ?? "", size: shape.size, openings: readOpenings(settings, height), shape, settings };
}

/** The heights of low sides, m, by a text that has each in cm behind the name of its side. */
function dropSides(text: string): Record<string, number> {
  const pairs = text.matchAll(/(\w+)\s+([\d.]+)/g);
  return Object.fromEntries(Array.from(pairs, ([, side, height]) => [side, Number(height) / 100]));
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
    const shape: Shape = {
      ...(types[layout] === "" ? {} : { type: types[layout] }),
      size,
      open_sides: open[layout].split(/\s+/).filter((side) => side !== ""),
      ...(low[layout] === "" ? {} : { drop_sides: dropSides(low[layout]) }),
      bed_height: beds[layout],
    };
    ownContainers.set(layout, containerOf(shape));
  }
  return { container, ownContainers };
}
