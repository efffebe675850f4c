import { boxText } from "../box/box_text";
import type { BoxColumns, World } from "../data/results";
import { NOT_COUNTED } from "../data/results";
import { element } from "../ui/dom";
import { type DrawnBox, FILLS, type State } from "./drawing";
import type { Bounds } from "./faces";

/** What drawings of a world tell of its boxes. */

export const isBeyond = ({ fallen, moved, tilted, unstable }: BoxColumns, box: number) =>
  fallen[box] + moved[box] + tilted[box] + unstable[box] > 0;

/** The box that was beyond a limit first, from 0; -1 where none was. */
export function firstBox({ boxes, criticalBox }: World): number {
  const box = criticalBox === NOT_COUNTED ? -1 : criticalBox - 1;
  return box >= 0 && boxes.id.some((_, i) => isBeyond(boxes, i)) ? box : -1;
}

/** Letters of a name in a table. */
const LONGEST_NAME = 40;

/** A name, cut where it is too long for a table. */
export const shortName = (name: string) =>
  name.length <= LONGEST_NAME ? name : `${name.slice(0, LONGEST_NAME - 1).trimEnd()}…`;

/** A box as the sheet calls it. */
export const boxName = ({ id, name }: BoxColumns, box: number) =>
  boxText({ id: id.subarray(box, box + 1), name: [shortName(name[box])] }, 0);

/** Where a box was as loaded. */
export function boundsOfBox({ boxes, loaded }: World, box: number): Bounds {
  const at = (offset: number, sign: number) =>
    [0, 1, 2].map((axis) =>
      loaded
        ? loaded.boxes[7 * box + offset + axis]
        : boxes.initial[3 * box + axis] - boxes.centre[3 * box + axis] + (sign * boxes.size[3 * box + axis]) / 2,
    );
  return { low: at(0, -1), high: at(3, 1) };
}

export const drawnBoxes = ({ id, name }: BoxColumns, states: readonly State[]): DrawnBox[] =>
  states.map((state, box) => ({ state, number: id[box], name: name[box] }));

export const figure = (picture: SVGElement, caption: string) =>
  element("figure", {}, picture, element("figcaption", {}, caption));

/** What the colours of a view mean that it has: of boxes that go first, that were beyond a limit, and that stayed. */
export function colourKey(states: readonly State[], meanings: readonly [string, string, string]): HTMLElement {
  const [first, later, still] = meanings;
  const all: [State, string][] = [
    ["first", first],
    ["later", later],
    ["still", still],
    ["fixed", "fixed, part of the container"],
  ];
  return element(
    "p",
    { class: "key" },
    ...all
      .filter(([state]) => states.includes(state))
      .flatMap(([state, meaning]) => [
        element("span", { class: state, style: `background-color: ${FILLS[state]}` }),
        meaning,
      ]),
  );
}
