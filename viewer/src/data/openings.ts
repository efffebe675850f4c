/** Sides of the container through which or over which boxes may leave, and boxes that are part of it, as the settings have them. */

/** The sides that stand up: the axis that they are across, and whether they are at its far end. */
export const UPRIGHT = [
  { name: "front", axis: 0, far: false },
  { name: "rear", axis: 0, far: true },
  { name: "left", axis: 1, far: false },
  { name: "right", axis: 1, far: true },
] as const;
export const REAR = 1;

/** cm: where the settings do not say it. Floors had no end in files of versions that did not know the key. */
const BED_HEIGHT = "0";

export interface Openings {
  /** m above the floor, per side of `UPRIGHT`; 0: the side is open */
  walls: number[];
  /** false: open */
  roof: boolean;
  /** m of the floor above the ground; 0: a floor without end */
  bedHeight: number;
}

type Settings = Readonly<Record<string, string>>;

const words = (text: string | undefined) => (text ?? "").toLowerCase().split(/[^a-z0-9.]+/);

/**
 * What is open or low.
 * @param height m, of the container
 */
export function readOpenings(settings: Settings, height: number): Openings {
  const open = words(settings["Container/OpenSides"]);
  // Each name has its height behind it, in cm.
  const low = words(settings["Container/DropSides"]);
  const walls = UPRIGHT.map(({ name }) => {
    if (open.includes(name)) return 0;
    const given = low.includes(name) ? Number(low[low.indexOf(name) + 1]) / 100 : height;
    return given >= 0 ? Math.min(given, height) : height;
  });
  const bedHeight = Number(settings["Container/BedHeight"] || BED_HEIGHT) / 100;
  return { walls, roof: !open.includes("roof"), bedHeight: bedHeight > 0 ? bedHeight : 0 };
}

export const isFull = (openings: Openings, side: number, height: number) => openings.walls[side] >= height;

/** Whether all sides are walls up to the roof, and the roof is there. */
export const isClosed = (openings: Openings, height: number) =>
  openings.roof && openings.walls.every((wall) => wall >= height);

/** The materials whose boxes are part of the container: numbers as texts, and names. */
export function fixedMaterials(settings: Settings): Set<string> {
  const fixed = new Set<string>();
  for (const [key, value] of Object.entries(settings)) {
    const material = /^Material (.+)\/Fixed$/.exec(key);
    if (material && /^(true|yes|1)$/i.test(value)) fixed.add(material[1]);
  }
  return fixed;
}

/** A side of `UPRIGHT`, or the roof after them, in words: "rear", "left side". */
export const sideName = (side: number) => {
  const name = UPRIGHT[side]?.name ?? "roof";
  return name === "left" || name === "right" ? `${name} side` : name;
};

const centimetres = (metres: number) => Number((100 * metres).toFixed(1));

/** What is open or low, in words; null: nothing. */
export function openingsText(openings: Openings, height: number): string | null {
  if (isClosed(openings, height)) return null;
  const names = UPRIGHT.map(({ name }) => name);
  const open: string[] = names.filter((_, side) => openings.walls[side] === 0);
  if (!openings.roof) open.push("roof");
  const low = names
    .map((name, side) => ({ name, wall: openings.walls[side] }))
    .filter(({ wall }) => wall > 0 && wall < height)
    .map(({ name, wall }) => `${name} ${centimetres(wall)} cm high`);
  const ground = openings.bedHeight > 0 ? `floor ${centimetres(openings.bedHeight)} cm above the ground` : "";
  return [open.length > 0 ? `${open.join(", ")} open` : "", ...low, ground].filter((part) => part !== "").join("; ");
}
