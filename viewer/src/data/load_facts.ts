import { UPRIGHT } from "./openings";
import { pushesOf } from "./push";
import type { BoxColumns, Container, Results, Segment } from "./results";

/** What a load is, whatever happens to it. Boxes that are part of the container do not count. */

const counted = ({ fixed }: Pick<BoxColumns, "fixed">) => [...fixed.keys()].filter((box) => !fixed[box]);

/** kg */
export const massOf = (boxes: Pick<BoxColumns, "fixed" | "mass">) =>
  counted(boxes).reduce((sum, box) => sum + boxes.mass[box], 0);

/** m, as loaded; null: the load weighs nothing. */
export function centreOfGravity(
  boxes: Pick<BoxColumns, "fixed" | "mass" | "initial">,
): [number, number, number] | null {
  const mass = massOf(boxes);
  if (!(mass > 0)) return null;
  const of = (axis: number) =>
    counted(boxes).reduce((sum, box) => sum + boxes.mass[box] * boxes.initial[3 * box + axis], 0) / mass;
  return [of(0), of(1), of(2)];
}

/** The CTU Code, Annex 7, section 3.1.4: a centre of gravity is at most this share of the length from the middle, in general. */
const ECCENTRICITY = 0.05;
export const ECCENTRICITY_SOURCE = "CTU Code 2014, Annex 7, 3.1.4";
/** Types of the catalogue that are no freight containers or swap bodies: their axles, or who stacks them, say where the load may lie. */
const NO_CONTAINER = /^(trailer|van|pallet)/;

/** Where the centre of gravity may lie, m from the front wall: from and to; null: that is not said of this kind of container. */
export function centreRange({ type, size }: Pick<Container, "type" | "size">): [number, number] | null {
  if (NO_CONTAINER.test(type)) return null;
  return [(0.5 - ECCENTRICITY) * size[0], (0.5 + ECCENTRICITY) * size[0]];
}

/**
 * What the norm of the run asks of a margin to each side of `UPRIGHT`, g: its largest push there of those that leave the load its
 * weight. Zeros without a norm.
 */
export function neededMargins({
  settings,
  accelerations,
  segments,
}: Pick<Results, "settings" | "accelerations" | "segments">): number[] {
  const most = UPRIGHT.map(() => 0);
  const norm = settings["Screening/Norm"]?.split(":")[0];
  if (!norm) return most;
  // Those of files have a point in their names.
  const ofNorm = segments.filter((_, i) => accelerations[i].startsWith(`${norm}-`) && !accelerations[i].includes("."));
  for (const { value } of ofNorm.flat() as Segment[])
    if (value[2] === 0) for (const [side, push] of pushesOf(value).entries()) most[side] = Math.max(most[side], push);
  return most;
}

/** Boxes that are alike. */
export interface Item {
  /** What they are called: the name without the number at its end, or the material; empty: neither */
  name: string;
  /** m, as they lie */
  size: [number, number, number];
  /** indices */
  boxes: number[];
  /** kg, of each */
  masses: number[];
}

/** The boxes of a load by name and size, in the order of the layout. */
export function itemsOf(boxes: Pick<BoxColumns, "fixed" | "name" | "material" | "size" | "mass">): Item[] {
  const items = new Map<string, Item>();
  for (const box of counted(boxes)) {
    const name = boxes.name[box].replace(/[\s_#.-]*\d+$/, "") || boxes.name[box] || materialName(boxes.material[box]);
    const size = [0, 1, 2].map((axis) => boxes.size[3 * box + axis]) as Item["size"];
    const key = JSON.stringify([name, ...size.map((side) => side.toFixed(3))]);
    const item = items.get(key) ?? { name, size, boxes: [], masses: [] };
    item.boxes.push(box);
    item.masses.push(boxes.mass[box]);
    items.set(key, item);
  }
  return [...items.values()];
}

const materialName = (material: string) => (/^-?\d+$/.test(material) ? "" : material);
