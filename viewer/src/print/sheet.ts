import { boxText } from "../box/box_text";
import { containerFactsOf } from "../box/container_facts";
import { departuresSentence } from "../box/departure";
import { frictionText } from "../data/friction";
import {
  centreOfGravity,
  centreRange,
  ECCENTRICITY_SOURCE,
  type Item,
  itemsOf,
  massOf,
  neededMargins,
} from "../data/load_facts";
import { isClosed, isFull, openingsText, REAR, UPRIGHT } from "../data/openings";
import { VERDICT_CODES } from "../data/outcome";
import { pushText } from "../data/push";
import { type BoxColumns, NOT_COUNTED, PRESSED, type Results, type World } from "../data/results";
import { caveatsOf } from "../data/status";
import { failing, JUDGED_AT_END, NOT_MODELLED, verdictText } from "../data/verdict";
import { DIRECTIONS, judgedMargins } from "../fleet/rows";
import { element } from "../ui/dom";
import { fixed, marginNumber, percent, plural, seconds } from "../ui/text";
import { drawLoad, FILLS, type PackedBox, type State, VIEW_NAMES, type View } from "./drawing";
import { NORM_SOURCES } from "./norm_sources";

/** Rows for which a page has room in its tables of boxes and of what is loaded, beside four accelerations; and those of margins or walls. */
const ROWS = 14;
const ROWS_OF_MARGINS = 6;
/** Rows that each of the two has anyway. */
const LEAST_ROWS = 3;
/** Pixels that the views are wide: two beside each other fill the page. */
const WIDTHS: Record<View, number> = { top: 330, side: 330, corner: 350 };

type Cell = string | HTMLElement;

/** kg, with a digit behind the point where it says something. */
const weight = (mass: number) => fixed(mass, mass >= 100 ? 0 : 1);
/** The shortest number, of a limit that somebody has set. */
const short = (value: number) => String(Number(value.toPrecision(6)));

const bad = (text: string) => element("span", { class: "bad" }, text);
const note = (...parts: Cell[]) => element("p", { class: "note" }, ...parts);

/** @param left columns beside the first that are aligned to the left */
function table(
  heads: readonly string[],
  rows: readonly (readonly Cell[])[],
  left: readonly number[] = [],
  kind = "",
): HTMLElement {
  const cells = (tag: "th" | "td", row: readonly Cell[]) =>
    row.map((cell, i) => element(tag, { class: left.includes(i) ? "text" : undefined }, cell));
  return element(
    "table",
    { class: kind || undefined },
    heads.some((head) => head !== "") ? element("tr", {}, ...cells("th", heads)) : null,
    ...rows.map((row) => element("tr", {}, ...cells("td", row))),
  );
}

/** A table without the columns that have nothing to say. */
function fittedTable(
  columns: readonly { head: string; left?: boolean; shown?: boolean }[],
  rows: readonly (readonly Cell[])[],
  kind = "",
) {
  const kept = columns.flatMap(({ shown }, i) => (shown === false ? [] : [i]));
  const left = kept.flatMap((i, at) => (columns[i].left ? [at] : []));
  return table(
    kept.map((i) => columns[i].head),
    rows.map((row) => kept.map((i) => row[i])),
    left,
    kind,
  );
}

const isBeyond = ({ fallen, moved, tilted, unstable }: BoxColumns, box: number) =>
  fallen[box] + moved[box] + tilted[box] + unstable[box] > 0;

/** The box that was beyond a limit first, from 0; -1 where none was. */
function firstBox({ boxes, criticalBox }: World): number {
  const box = criticalBox === NOT_COUNTED ? -1 : criticalBox - 1;
  return box >= 0 && boxes.id.some((_, i) => isBeyond(boxes, i)) ? box : -1;
}

function packed(boxes: BoxColumns, { loaded }: World, states: readonly State[]): PackedBox[] {
  return states.map((state, box) => {
    const at = (offset: number, sign: number) =>
      [0, 1, 2].map((axis) =>
        loaded
          ? loaded.boxes[7 * box + offset + axis]
          : boxes.initial[3 * box + axis] - boxes.centre[3 * box + axis] + (sign * boxes.size[3 * box + axis]) / 2,
      );
    return { low: at(0, -1), high: at(3, 1), state, number: boxes.id[box], name: boxes.name[box] };
  });
}

/** What became of each box under all of the accelerations. */
function statesOf(worlds: readonly World[]): State[] {
  const states: State[] = Array.from(worlds[0].boxes.fixed, (fixed) => (fixed ? "fixed" : "still"));
  for (const { boxes } of worlds)
    for (const box of states.keys()) if (states[box] === "still" && isBeyond(boxes, box)) states[box] = "later";
  for (const world of worlds) if (firstBox(world) >= 0) states[firstBox(world)] = "first";
  return states;
}

function views(world: World, states: readonly State[]): HTMLElement {
  const { size, openings } = world.container;
  const boxes = packed(world.boxes, world, states);
  const door = isFull(openings, REAR, size[2]) ? "door" : "rear";
  const figure = (view: View) =>
    element(
      "figure",
      {},
      drawLoad(boxes, size, openings, view, WIDTHS[view]),
      element("figcaption", {}, view === "corner" ? `from above the ${door}` : VIEW_NAMES[view]),
    );
  return element("div", { class: "views" }, element("div", {}, figure("top"), figure("side")), figure("corner"));
}

function key(states: readonly State[]): HTMLElement {
  const meanings: [State, string][] = [
    ["first", "first to go under some acceleration"],
    ["later", "beyond a limit"],
    ["still", "stayed under all"],
    ["fixed", "fixed, part of the container"],
  ];
  return element(
    "p",
    { class: "key" },
    ...meanings
      .filter(([state]) => states.includes(state))
      .flatMap(([state, meaning]) => [element("span", { style: `background: ${FILLS[state]}` }), meaning]),
  );
}

function matsSentence({ mat, id }: BoxColumns): string {
  const kinds = [...new Set(mat.filter(Number.isFinite))].sort((a, b) => a - b);
  const told = kinds.map((kind) => {
    const boxes = [...id.keys()].filter((box) => mat[box] === kind).map((box) => id[box]);
    return `on a mat of ${Number(kind.toPrecision(3))}: ${boxes.length === 1 ? "box" : "boxes"} ${boxes.join(", ")}`;
  });
  return told.length > 0 ? `${capital(told.join("; "))}.` : "";
}

const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

function centreText(world: World): Cell[] {
  const centre = centreOfGravity(world.boxes);
  if (!centre) return ["–"];
  const { container } = world;
  const [x, y, z] = centre.map((part) => `${fixed(part, 2)} m`);
  const where = `${x} from the front wall (${percent(centre[0] / container.size[0])} of the length), ${y} from the left side, ${z} above the floor`;
  const range = centreRange(container);
  if (!range) return [`${where}. Axle loads are not calculated.`];
  const [low, high] = range.map((part) => fixed(part, 2));
  const may = `It may lie from ${low} m to ${high} m from the front wall (${ECCENTRICITY_SOURCE})`;
  const within = centre[0] >= range[0] && centre[0] <= range[1];
  return [`${where}. `, within ? `${may}: it does.` : bad(`${may}: it does not.`)];
}

/** How a run was made. */
export function runFacts(results: Results): [string, string][] {
  const { settings, thresholds } = results;
  const norm = settings["Screening/Norm"] ?? "";
  const source = NORM_SOURCES[norm.split(":")[0]];
  const accuracy = results.engine === "native" ? ` ${settings["Native/Accuracy"] ?? ""}` : "";
  const limits = `displaced by ${short(100 * thresholds.move)} cm, lowered by ${short(100 * thresholds.drop)} cm, tilted by ${short(thresholds.tilt)}°`;
  const facts: [string, string][] = [
    ["norm", norm === "" ? "none: accelerations of files" : source ? `${norm}: ${source}` : norm],
    ["friction", frictionText(settings)],
    ["limits", `${limits}, ${results.judgedAtEnd ? "at the end" : "at any time"}`],
    [
      "simulated",
      `${results.software}, ${results.engine}${accuracy}, ${results.created.replace("T", " ").replace("Z", " UTC")}`,
    ],
  ];
  return facts;
}

function facts(results: Results, world: World): HTMLElement {
  const container = containerFactsOf(world.container).map(([, text]) => text);
  const rows: Cell[][] = [
    ["container", container.join("; ")],
    ["centre of gravity", element("span", {}, ...centreText(world))],
    ...runFacts(results).map(([name, text]) => [name, text]),
  ];
  return table(["", ""], rows, [1], "wrap");
}

/** The kinds of boxes; none where boxes have no names and hardly two are alike: such a list says nothing that the drawings do not. */
function toldItems(boxes: BoxColumns): Item[] {
  const all = itemsOf(boxes);
  return all.length > ROWS && all.every(({ name }) => name === "") ? [] : all;
}

function itemsTable(all: readonly Item[], most: number): HTMLElement | null {
  if (all.length === 0) return null;
  const size = (item: Item) => item.size.map((side) => Number((100 * side).toFixed(1))).join(" × ");
  const rows = all.slice(0, most).map((item) => {
    const { name, masses } = item;
    const [least, most] = [Math.min(...masses), Math.max(...masses)].map(weight);
    const each = least === most ? least : `${least} to ${most}`;
    const sum = masses.reduce((sofar, mass) => sofar + mass, 0);
    return [name || "box", String(masses.length), size(item), `${each} kg`, `${weight(sum)} kg`];
  });
  const rest = all.slice(most).reduce((sum, { masses }) => sum + masses.length, 0);
  return element(
    "div",
    {},
    element("h3", {}, "What is loaded"),
    table(["item", "number", "length × width × height, cm", "each", "together"], rows),
    rest > 0 ? element("p", {}, `and ${plural(rest, "more box")}`) : null,
  );
}

/** A number beside a limit, with as many digits as it takes to see whether it is beyond. */
function besideLimit(value: number, limit: number): string {
  if (!Number.isFinite(value)) return "–";
  const texts = [0, 1, 2, 3].map((digits) => fixed(value, digits));
  return texts.find((text) => Number(text) > limit === value > limit) ?? texts[3];
}

/** A number at its largest, and in brackets at the end, beside its limit. */
const mostAndLast = (most: number, last: number, limit: number) =>
  `${besideLimit(most, limit)} (${besideLimit(last, limit)})`;

const when = (time: number) => (Number.isNaN(time) ? "–" : time >= 0 ? seconds(time) : "settling");

function worldsTable(results: Results, worlds: readonly World[]): HTMLElement[] {
  const { worlds: columns, replicas, thresholds } = results;
  const caveats = new Map<string, string>();
  const rows = worlds.map((world): Cell[] => {
    const { index, verdict, stopReason, boxes } = world;
    const name = world.acceleration;
    const to = pushText(world.segments);
    const text = verdictText(verdict, stopReason);
    if (verdict === VERDICT_CODES.failed || verdict === VERDICT_CODES.not_needed)
      return [name, to, text, "", "", "", "", "", "", world.statusText];
    for (const { name: caveat, meaning } of caveatsOf(columns.caveats[index])) caveats.set(caveat, meaning);
    const first = firstBox(world);
    const at = boxes.firstBeyond[first];
    const told =
      replicas && replicas.count[index] > 0 ? `${replicas.failed[index]} of ${replicas.count[index]} fail` : "";
    return [
      name,
      to,
      failing(verdict) ? bad(text) : text,
      first < 0 ? "–" : boxText(boxes, first) + (Number.isNaN(at) ? "" : `, ${when(at)}`),
      `${columns.fallen[index]} (${columns.fallenAtEnd[index]})`,
      String(columns.moved[index]),
      String(columns.tilted[index]),
      mostAndLast(100 * columns.peakDisplacement[index], 100 * columns.endDisplacement[index], 100 * thresholds.move),
      told,
      [...caveatsOf(columns.caveats[index]).map(({ name: caveat }) => caveat), world.statusText]
        .filter(Boolean)
        .join(", "),
    ];
  });
  const heads = [
    { head: "acceleration" },
    { head: "pushed to", left: true },
    { head: "verdict", left: true },
    { head: "goes first", left: true },
    { head: "fallen" },
    { head: "moved" },
    { head: "tilted" },
    { head: "farthest, cm" },
    { head: "replicas", left: true, shown: rows.some((row) => row[8] !== "") },
    { head: "to know", left: true, shown: rows.some((row) => row[9] !== "") },
  ];
  const explained = [...caveats].map(
    ([name, meaning]) => `${capital(name)}: ${meaning.charAt(0).toLowerCase()}${meaning.slice(1)}`,
  );
  return [
    fittedTable(heads, rows, "wrap"),
    note(
      ["In brackets: at the end.", ...explained, NOT_MODELLED, ...(results.judgedAtEnd ? [JUDGED_AT_END] : [])].join(
        " ",
      ),
    ),
  ];
}

function departures(results: Results, worlds: readonly World[]): HTMLElement[] {
  return worlds.flatMap((world) => {
    const sentence = departuresSentence(results, world);
    return sentence ? [element("p", {}, `Under ${world.acceleration}: ${sentence}`)] : [];
  });
}

function marginsTable(results: Results, layout: number, world: World): HTMLElement | null {
  const { margins } = results;
  if (!margins) return null;
  const own = (all: ArrayLike<number>, i: number) => all[4 * layout + i];
  const judged = judgedMargins(margins);
  if (DIRECTIONS.every((_, i) => Number.isNaN(own(judged.margin, i)))) return null;
  const text = (value: number) => (value >= 0 ? `${marginNumber(value)} g` : marginNumber(value));
  const needed = neededMargins(results);
  const rows = DIRECTIONS.map((direction, i): Cell[] => {
    const value = own(judged.margin, i);
    const box = own(judged.criticalBox, i);
    return [
      direction,
      text(own(margins.inPlace.margin, i)),
      value + 1e-6 < needed[i] ? bad(text(value)) : text(value),
      needed[i] > 0 ? `${Number(needed[i].toPrecision(3))} g` : "–",
      box > 0 ? boxText(world.boxes, box - 1) : "–",
    ];
  });
  const heads = [
    { head: "pushed to" },
    { head: "in place", shown: margins.withinLimits !== null },
    { head: margins.withinLimits ? "within limits" : "in place" },
    { head: "needed" },
    { head: "goes first above", left: true },
  ];
  return element("div", {}, element("h3", {}, "How many g it stands"), fittedTable(heads, rows));
}

function wallsTable(results: Results, worlds: readonly World[]): HTMLElement | null {
  const pressed = worlds.filter(({ walls }) => walls !== null);
  if (pressed.length === 0) return null;
  const rows = UPRIGHT.flatMap(({ name }, side): Cell[][] => {
    if (worlds[0].container.openings.walls[side] === 0) return [];
    const at = PRESSED.indexOf(name);
    const lasting = (world: World) => world.walls?.lasting[at] ?? 0;
    const world = pressed.reduce((most, next) => (lasting(next) > lasting(most) ? next : most));
    const [force, limit] = [lasting(world), world.walls?.limit[at] ?? Number.NaN];
    const kilonewtons = (value: number) => `${fixed(value / 1000, 1)} kN`;
    const share = limit > 0 ? percent(force / limit) : "–";
    return [
      [
        name,
        kilonewtons(force),
        limit > 0 ? kilonewtons(limit) : "–",
        force > limit ? bad(share) : share,
        world.acceleration,
      ],
    ];
  });
  const norm = results.settings["Screening/Walls"] ?? "";
  return element(
    "div",
    {},
    element("h3", {}, `Force on the walls${norm === "" ? "" : `, limits of ${norm}`}`),
    table(["wall", "largest", "limit", "share", "under"], rows, [4]),
  );
}

/** The boxes that were beyond a limit, under the acceleration in which each went farthest. */
function farthestBoxes(worlds: readonly World[]): [number, World][] {
  const found = new Map<number, World>();
  for (const world of worlds)
    for (const box of world.boxes.id.keys()) {
      if (!isBeyond(world.boxes, box)) continue;
      const known = found.get(box);
      if (!known || world.boxes.judged.displacement[box] > known.boxes.judged.displacement[box]) found.set(box, world);
    }
  const farthest = ([box, world]: [number, World]) => world.boxes.judged.displacement[box];
  return [...found].sort((a, b) => farthest(b) - farthest(a) || a[0] - b[0]);
}

function boxesTable({ thresholds }: Results, found: readonly [number, World][], most: number): HTMLElement | null {
  if (found.length === 0) return null;
  const rows = found.slice(0, most).map(([box, world]): Cell[] => {
    const { boxes } = world;
    const { peak, end } = boxes;
    const size = [...boxes.size.subarray(3 * box, 3 * box + 3)].map((side) => Number((100 * side).toFixed(1)));
    return [
      String(boxes.id[box]),
      boxes.name[box],
      size.join(" × "),
      weight(boxes.mass[box]),
      mostAndLast(100 * peak.displacement[box], 100 * end.displacement[box], 100 * thresholds.move),
      mostAndLast(100 * peak.drop[box], 100 * end.drop[box], 100 * thresholds.drop),
      mostAndLast(peak.tilt[box], end.tilt[box], thresholds.tilt),
      when(boxes.firstBeyond[box]),
      world.verdict === VERDICT_CODES.unstable ? "gravity alone" : world.acceleration,
    ];
  });
  const named = found[0][1].boxes.name.some((name) => name !== "");
  const heads = [
    { head: "box" },
    { head: "name", left: true, shown: named },
    { head: "size, cm" },
    { head: "mass, kg" },
    { head: "farthest, cm" },
    { head: "drop, cm" },
    { head: "tilt, °" },
    { head: "beyond from" },
    { head: "under", left: true },
  ];
  const more = found.length - rows.length;
  return element(
    "div",
    {},
    element("h3", {}, "What went beyond a limit"),
    fittedTable(heads, rows, named ? "many" : ""),
    more > 0 ? element("p", {}, `and ${plural(more, "more box")}`) : null,
  );
}

/** Rows of a table that shares the room of a page with another one, which has so many at most. */
const rowsFor = (room: number, other: number) => Math.max(LEAST_ROWS, room - Math.min(other, Math.floor(room / 2)));

/** How the worlds ended, to the bit. */
const hashes = (worlds: readonly World[]) =>
  note(
    `Hashes of the ends: ${worlds.map(({ acceleration, stateHash }) => `${acceleration} ${stateHash}`).join(", ")}.`,
  );

function headline(world: World, worlds: readonly World[]): HTMLElement {
  const { boxes, container } = world;
  const free = [...boxes.fixed.keys()].filter((box) => !boxes.fixed[box]);
  const volume = free.reduce((sum, box) => {
    const [x, y, z] = boxes.size.subarray(3 * box, 3 * box + 3);
    return sum + x * y * z;
  }, 0);
  const [length, width, height] = container.size;
  const parts = boxes.fixed.length - free.length;
  const load = `${plural(free.length, "box")} of ${weight(massOf(boxes))} kg, ${percent(volume / (length * width * height))} of the container's volume${parts > 0 ? `, and ${parts} fixed` : ""}; `;
  const fails = worlds.filter(({ verdict }) => failing(verdict) || verdict === VERDICT_CODES.failed).length;
  const all = plural(worlds.length, "acceleration");
  const holds = worlds.every(({ verdict }) => verdict === VERDICT_CODES.stayed);
  const verdict = holds
    ? element("span", { class: "good" }, `holds under ${worlds.length === 1 ? "its acceleration" : `all ${all}`}`)
    : bad(`fails under ${fails} of ${all}`);
  return element("p", {}, boxes.id.length > 0 ? load : "", verdict, ".");
}

/**
 * A page to print of a load: what it is, what it stands, and what goes first. The order is that of `holdfast report`.
 * @param worlds of the layout, one per acceleration
 */
export function loadSheet(results: Results, layout: number, worlds: readonly World[]): HTMLElement {
  const simulated = worlds.filter(({ boxes }) => boxes.id.length > 0);
  const [world] = simulated;
  const title = element("h2", {}, results.layouts[layout]);
  if (!world) return element("section", {}, title, headline(worlds[0], worlds), ...worldsTable(results, worlds));
  const states = statesOf(simulated);
  const { size, openings } = world.container;
  const mats = matsSentence(world.boxes);
  const left = departures(results, simulated);
  const [margins, walls] = [marginsTable(results, layout, world), wallsTable(results, simulated)];
  const room = ROWS - (margins || walls ? ROWS_OF_MARGINS : 0) - left.length - Math.max(0, worlds.length - 4);
  const [beyond, items] = [farthestBoxes(simulated), toldItems(world.boxes)];
  const sides = isClosed(openings, size[2]) ? null : openingsText(openings, size[2]);
  return element(
    "section",
    {},
    title,
    headline(world, worlds),
    views(world, states),
    key(states),
    mats === "" ? null : note(mats),
    sides ? note(`${capital(sides)}. The floor is dashed where no wall stands on it.`) : null,
    facts(results, world),
    ...worldsTable(results, worlds),
    ...left,
    element("div", { class: "beside" }, margins, walls),
    boxesTable(results, beyond, rowsFor(room, items.length)),
    itemsTable(items, rowsFor(room, beyond.length)),
    hashes(simulated),
  );
}
