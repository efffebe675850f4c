import { sideLeft } from "../box/departure";
import { sideName } from "../data/openings";
import { VERDICT_CODES } from "../data/outcome";
import type { Results, World } from "../data/results";
import { element } from "../ui/dom";
import { draw, type Room, type State, VIEW_NAMES } from "./drawing";
import { isNear, type Point, SURROUNDINGS, type TurnedBox, turnedFaces } from "./faces";
import { boundsOfBox, boxName, colourKey, drawnBoxes, figure, firstBox, isBeyond } from "./packed_load";
import { note, numbersText, part } from "./tables";

/** How boxes have left the container at the end of a world. */

/** Pixels of a picture. */
const ROOM: Room = [330, 150];
/** Boxes that a note names. */
const MOST_FAR = 20;

const startOf = ({ boxes }: World, box: number): Point => [...boxes.reference.subarray(3 * box, 3 * box + 3)];
const endOf = (world: World, box: number): Point =>
  startOf(world, box).map((part, axis) => part + world.boxes.endDisplacement[3 * box + axis]);

/** What a world went under: its acceleration, or gravity where the load did not stand as it was. */
export const underText = ({ verdict, acceleration }: World) =>
  verdict === VERDICT_CODES.unstable ? "gravity alone" : acceleration;

/** The side at which each box left that is outside at the end, of `UPRIGHT` or the roof after them. */
export function sidesLeft(results: Results, world: World): Map<number, number> {
  const sides = new Map<number, number>();
  for (const box of world.boxes.id.keys()) {
    const side = sideLeft(results, world, box);
    if (side >= 0) sides.set(box, side);
  }
  return sides;
}

/** How boxes leave the container under each acceleration, or before any, as sentences. */
export function departures(results: Results, worlds: readonly World[]): HTMLElement[] {
  const sentences = worlds.flatMap((world) => {
    const way = (side: number) =>
      `${world.container.openings.walls[side] > 0 ? "over the low" : "through the open"} ${sideName(side)}`;
    const sides = sidesLeft(results, world);
    const first = firstBox(world);
    const firstSide = sides.get(first);
    sides.delete(first);
    const told =
      firstSide === undefined ? [] : [`${boxName(world.boxes, first)}, which goes first, leaves ${way(firstSide)}`];
    const more = told.length > 0 ? " more" : "";
    const ways = new Map<string, number>();
    for (const side of sides.values()) ways.set(way(side), (ways.get(way(side)) ?? 0) + 1);
    told.push(...[...ways].map(([text, number]) => `${number}${more} ${number === 1 ? "leaves" : "leave"} ${text}`));
    if (told.length === 0) return [];
    const [last, ...others] = told.reverse();
    const list = [others.reverse().join(", "), last].filter((text) => text !== "").join(" and ");
    return [`Under ${underText(world)}, ${list}.`];
  });
  // All worlds under gravity alone are the same.
  return [...new Set(sentences)].map((sentence) => element("p", {}, sentence));
}

/**
 * The load as it lies at the end of the world in which most boxes leave the container, with those on the ground; null where none
 * leaves, or where it is not known how boxes have turned.
 */
export function endViews(results: Results, worlds: readonly World[]): HTMLElement | null {
  const left = worlds.map((world) => sidesLeft(results, world).size);
  const most = Math.max(0, ...left);
  const world = worlds[left.indexOf(most)];
  if (most === 0 || !world.series || world.series.time.length === 0) return null;
  const { boxes, series, container } = world;
  const count = boxes.id.length;
  const turns = series.orientation.subarray(4 * count * (series.time.length - 1));
  const states = Array.from(boxes.id, (_, box): State => {
    if (box === firstBox(world)) return "first";
    if (isBeyond(boxes, box)) return "later";
    return boxes.fixed[box] ? "fixed" : "still";
  });
  const turned = states.map((_, box): TurnedBox => {
    const { low, high } = boundsOfBox(world, box);
    const fromCentre = (point: Point) => point.map((part, axis) => part - boxes.initial[3 * box + axis]);
    return {
      loaded: { low: fromCentre(low), high: fromCentre(high) },
      turn: [...turns.subarray(4 * box, 4 * box + 4)],
      centre: endOf(world, box),
    };
  });
  const viewOf = (view: "top" | "corner", caption: string) => {
    const near = turnedFaces(turned, view).filter(({ box }) => isNear(turned[box].centre, container.size));
    return figure(draw(near, drawnBoxes(boxes, states), container, view, ROOM, false), caption);
  };
  const far = turned.flatMap(({ centre }, box) => (isNear(centre, container.size) ? [] : [boxes.id[box]]));
  return part(
    `At the end under ${underText(world)}`,
    element("div", { class: "views" }, viewOf("top", VIEW_NAMES.top), viewOf("corner", "from the corner")),
    colourKey(states, ["first to go", "beyond a limit at some time", "stayed"]),
    far.length > 0
      ? note(`More than ${SURROUNDINGS} m from the container, and not drawn: ${numbersText(far, MOST_FAR)}.`)
      : null,
  );
}
