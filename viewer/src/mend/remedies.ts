import type { Load } from "holdfast-engine";
import { boxText } from "../box/box_text";
import { sideName, UPRIGHT } from "../data/openings";
import type { World } from "../data/results";
import { against, closedUp, isSame, lowered, MAT, type Side, withMats } from "./load_edits";

/** Something that may help a load: it has to be tried. */
export interface Remedy {
  /** in the words of who loads */
  text: string;
  load: Load;
}

/** The side of `UPRIGHT` that an acceleration presses the load to; null: to none. */
export function pressedSide({ segments }: Pick<World, "segments">): number | null {
  const sum = [0, 1].map((axis) => segments.reduce((all, { duration, value }) => all + duration * value[axis], 0));
  const axis = Math.abs(sum[0]) >= Math.abs(sum[1]) ? 0 : 1;
  if (sum[axis] === 0) return null;
  // What the container gains, the load is left behind by.
  return UPRIGHT.findIndex((side) => side.axis === axis && side.far === sum[axis] < 0);
}

/** What may help in a world, for its critical box and for all boxes, where it is a change. */
export function remediesOf(load: Load, world: World): Remedy[] {
  const { boxes, container } = world;
  const side = pressedSide(world);
  const box = world.criticalBox - 1;
  const found: { text: string; load: Load | null }[] = [];
  const isFixed = (index: number) => boxes.fixed[index] === 1;
  const beyond = [...load.boxes.keys()].filter(
    (index) => (boxes.moved[index] | boxes.fallen[index] | boxes.tilted[index]) !== 0,
  );
  if (box >= 0) {
    const name = boxText(boxes, box, "Box");
    if (side !== null) {
      const to: Side = UPRIGHT[side];
      found.push({
        text: `${name} towards the ${sideName(side)}, until it touches`,
        load: against(load, box, to, container.size),
      });
    }
    found.push({ text: `${name} down to the floor`, load: lowered(load, box, container.size) });
    found.push({ text: `A mat beneath ${name.replace("Box", "box")}`, load: withMats(load, [box], MAT) });
  }
  if (side !== null)
    found.push({
      text: `All boxes towards the ${sideName(side)}, until they touch`,
      load: closedUp(load, UPRIGHT[side], container.size, isFixed),
    });
  if (beyond.length > 1)
    found.push({
      text: `Mats beneath the ${beyond.length} boxes that went beyond a limit`,
      load: withMats(load, beyond, MAT),
    });
  const known: Load[] = [load];
  return found.flatMap(({ text, load: next }) => {
    if (!next || known.some((one) => isSame(one, next))) return [];
    known.push(next);
    return [{ text, load: next }];
  });
}
