import type { Load, LoadBox } from "holdfast-engine";
import { high, low, NEAR, placedAt, TOUCHING } from "./load_edits";

/** Share of its base that lies on the floor or on boxes: with more than a half, its middle is above them. */
const CARRIED = 0.75;

/** How much a box has in common with the stretch from a place along an axis on, m; 0 or less: nothing. */
const common = (box: LoadBox, axis: number, from: number, length: number) =>
  Math.min(high(box, axis), from + length) - Math.max(low(box, axis), from);

const ascending = (values: readonly number[]) => [...new Set(values)].sort((a, b) => a - b);

/**
 * The load with one more box, its last one, at the first place where it stands: the lowest one, of these the nearest to the front wall,
 * and of these the nearest to the left side. Places are at walls and at faces of boxes; the box overlaps nothing there, and at least
 * three quarters of its base are carried. Null: there is no such place.
 */
export function withOneMore(load: Load, box: LoadBox, size: readonly number[]): Load | null {
  const { boxes } = load;
  const floor: LoadBox = { corner_min: [0, 0, -1], corner_max: [size[0], size[1], 0], material: 0 };
  const [length, width, height] = [0, 1, 2].map((axis) => high(box, axis) - low(box, axis));
  const stops = (axis: number, extent: number, beside: readonly LoadBox[], beneath: readonly LoadBox[]) =>
    ascending([
      0,
      ...beside.map((other) => high(other, axis)),
      ...beneath.flatMap((other) => [low(other, axis), high(other, axis) - extent]),
    ]).filter((stop) => stop >= 0 && stop + extent <= size[axis] + TOUCHING);
  const enough = CARRIED * length * width;
  for (const z of ascending([floor, ...boxes].map((other) => high(other, 2)))) {
    if (z + height > size[2] + TOUCHING) break;
    const beside = boxes.filter((other) => common(other, 2, z, height) > TOUCHING);
    const beneath = [floor, ...boxes].filter((other) => z - NEAR < high(other, 2) && high(other, 2) <= z);
    for (const x of stops(0, length, beside, beneath)) {
      const isAcross = (other: LoadBox) => common(other, 0, x, length) > TOUCHING;
      const carrying = beneath.filter(isAcross);
      const carried = (from: number, across: number) =>
        carrying.reduce(
          (sum, other) => sum + common(other, 0, x, length) * Math.max(0, common(other, 1, from, across)),
          0,
        );
      // At most heights too little is carried anywhere across: what stands there need not be looked at.
      if (carried(0, size[1]) < enough) continue;
      const near = beside.filter(isAcross);
      for (const y of stops(1, width, near, carrying)) {
        if (near.some((other) => common(other, 1, y, width) > TOUCHING)) continue;
        if (carried(y, width) >= enough) return placedAt({ ...load, boxes: [...boxes, box] }, boxes.length, [x, y, z]);
      }
    }
  }
  return null;
}
