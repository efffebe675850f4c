import { containerFactsOf } from "../box/container_facts";
import { frictionOfMaterials, usualFriction } from "../data/friction";
import {
  centreOfGravity,
  centreRange,
  ECCENTRICITY_SOURCE,
  type Item,
  itemsOf,
  massOf,
  neededMargins,
} from "../data/load_facts";
import { isClosed, isFull, openingsText, REAR, sideName, UPRIGHT } from "../data/openings";
import { VERDICT_CODES } from "../data/outcome";
import { pushText } from "../data/push";
import { type BoxColumns, PRESSED, type Results, type World } from "../data/results";
import { caveatsOf } from "../data/status";
import { failing, JUDGED_AT_END, NOT_MODELLED, verdictText } from "../data/verdict";
import { DIRECTIONS, judgedMargins } from "../fleet/rows";
import { element } from "../ui/dom";
import { fixed, LARGEST_MARGIN, marginNumber, percent, plural } from "../ui/text";
import { bearingTable, type LimitedBox } from "./bearing";
import { draw, HIGHEST, roomsOfViews, type State, VIEW_NAMES } from "./drawing";
import { departures, endViews, sidesLeft, underText } from "./end_of_world";
import { packedFaces, type View } from "./faces";
import { NORM_SOURCES } from "./norm_sources";
import { boundsOfBox, boxName, colourKey, drawnBoxes, figure, firstBox, isBeyond, shortName } from "./packed_load";
import {
  bad,
  type Cell,
  type Column,
  capital,
  listed,
  moreBoxes,
  mostAndLast,
  note,
  numbersText,
  part,
  short,
  table,
  weight,
  when,
} from "./tables";

/** Lines for which a page has room in its tables of boxes, of bearing and of what is loaded, beside four accelerations. */
const LINES = 20;
/** Those that margins or walls take of them at least, those of the views of the end, of the heads of a table, and of
 * a second caveat that is explained. */
const LINES_OF_MARGINS = 6;
const LINES_OF_END = 12;
const LINES_OF_HEADS = 4;
const LINES_OF_CAVEAT = 2;
/** Rows that each table has anyway. */
const LEAST_ROWS = 3;
/** That a load has where these do not fit; names may take two of them. */
const LINES_OF_SECOND_PAGE = 20;
/** Pixels. */
const LINE_HEIGHT = 18;
/** Kinds of boxes without names that are listed. */
const MOST_UNNAMED = 14;
/** Of numbers of boxes, in a list of what is loaded. */
const MOST_RANGES = 8;
/** Boxes that a note names. */
const MOST_ON_MATS = 20;
/** Materials that a line names. */
const MOST_MATERIALS = 6;
/** Columns of a table whose heads are in a line. */
const FEW_COLUMNS = 9;

/** What became of each box under all of the accelerations. */
function statesOf(worlds: readonly World[]): State[] {
  const states: State[] = Array.from(worlds[0].boxes.fixed, (fixed) => (fixed ? "fixed" : "still"));
  for (const { boxes } of worlds)
    for (const box of states.keys()) if (states[box] === "still" && isBeyond(boxes, box)) states[box] = "later";
  for (const world of worlds) if (firstBox(world) >= 0) states[firstBox(world)] = "first";
  return states;
}

function views(world: World, states: readonly State[]): HTMLElement[] {
  const { container } = world;
  const [boxes, rooms] = [drawnBoxes(world.boxes, states), roomsOfViews(container)];
  const bounds = states.map((_, box) => boundsOfBox(world, box));
  const door = isFull(container.openings, REAR, container.size[2]) ? "door" : "rear";
  const viewOf = (view: View) =>
    figure(
      draw(packedFaces(bounds, view), boxes, container, view, rooms[view], true),
      view === "corner" ? `from above the ${door}` : VIEW_NAMES[view],
    );
  const rows: View[][] = [
    ["top", "corner"],
    ["side", "rear", "front"],
  ];
  return rows.map((row) => element("div", { class: "views" }, ...row.map(viewOf)));
}

function matsSentence({ mat, id }: BoxColumns): string {
  const kinds = [...new Set(mat.filter(Number.isFinite))].sort((a, b) => a - b);
  const told = kinds.map((kind) => {
    const boxes = [...id.keys()].filter((box) => mat[box] === kind).map((box) => id[box]);
    return `on a mat of ${Number(kind.toPrecision(3))}: ${numbersText(boxes, MOST_ON_MATS)}`;
  });
  return told.length > 0 ? `${capital(told.join("; "))}.` : "";
}

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
    ["friction", usualFriction(settings)],
    ["of materials", listed(frictionOfMaterials(settings), MOST_MATERIALS, "; ")],
    ["limits", `${limits}, ${results.judgedAtEnd ? "at the end" : "at any time"}`],
    [
      "simulated",
      `${results.software}, ${results.engine}${accuracy}, ${results.created.replace("T", " ").replace("Z", " UTC")}`,
    ],
  ];
  return facts.filter(([, text]) => text !== "");
}

function facts(results: Results, world: World): HTMLElement {
  const container = containerFactsOf(world.container).map(([, text]) => text);
  const rows: Cell[][] = [
    ["container", container.join("; ")],
    ["centre of gravity", element("span", {}, ...centreText(world))],
    ...runFacts(results).map(([name, text]) => [name, text]),
  ];
  return table([{ head: "" }, { head: "", kind: "text" }], rows, "wrap");
}

/** The kinds of boxes; none where boxes have no names and hardly two are alike: such a list says nothing that the drawings do not. */
function toldItems(boxes: BoxColumns): Item[] {
  const all = itemsOf(boxes);
  return all.length > MOST_UNNAMED && all.every(({ name }) => name === "") ? [] : all;
}

/** Numbers in ascending order, those that follow each other together. */
export function rangesText(numbers: readonly number[]): string {
  const ranges: [number, number][] = [];
  for (const number of numbers) {
    const last = ranges.at(-1);
    if (last?.[1] === number - 1) last[1] = number;
    else ranges.push([number, number]);
  }
  const texts = ranges.map(([first, last]) =>
    first === last ? String(first) : `${first}${last === first + 1 ? ", " : " to "}${last}`,
  );
  return texts.slice(0, MOST_RANGES).join(", ") + (texts.length > MOST_RANGES ? ", …" : "");
}

function itemsTable(all: readonly Item[], ids: ArrayLike<number>, most: number): HTMLElement | null {
  if (all.length === 0) return null;
  const rows = all.slice(0, most).map(({ name, size, boxes, masses }) => {
    const [least, most] = [Math.min(...masses), Math.max(...masses)].map(weight);
    return [
      name || "box",
      String(masses.length),
      sizeText(size),
      `${least === most ? least : `${least} to ${most}`} kg`,
      `${weight(masses.reduce((sofar, mass) => sofar + mass, 0))} kg`,
      rangesText(boxes.map((box) => ids[box])),
    ];
  });
  const columns = ["item", "number", "length × width × height, cm", "each", "together"].map((head) => ({ head }));
  const rest = all.slice(most).reduce((sum, { masses }) => sum + masses.length, 0);
  return part(
    "What is loaded",
    table([...columns, { head: "boxes", kind: "text" }], rows, "wrap items"),
    moreBoxes(rest),
  );
}

const sizeText = (size: readonly number[]) => size.map((side) => Number((100 * side).toFixed(1))).join(" × ");

function worldsTable(results: Results, worlds: readonly World[]): HTMLElement[] {
  const { worlds: summary, replicas, thresholds } = results;
  const caveats = new Map<string, string>();
  const rows = worlds.map((world): Cell[] => {
    const { index, verdict, stopReason, boxes } = world;
    const name = world.acceleration;
    const to = pushText(world.segments);
    const text = verdictText(verdict, stopReason);
    if (verdict === VERDICT_CODES.failed || verdict === VERDICT_CODES.not_needed)
      return [name, to, text, "", "", "", "", "", "", world.statusText];
    for (const { name: caveat, meaning } of caveatsOf(summary.caveats[index])) caveats.set(caveat, meaning);
    const first = firstBox(world);
    const at = boxes.firstBeyond[first];
    const told =
      replicas && replicas.count[index] > 0 ? `${replicas.failed[index]} of ${replicas.count[index]} fail` : "";
    return [
      name,
      to,
      failing(verdict) ? bad(text) : text,
      first < 0 ? "–" : boxName(boxes, first) + (Number.isNaN(at) ? "" : `, ${when(at)}`),
      `${summary.fallen[index]} (${summary.fallenAtEnd[index]})`,
      String(summary.moved[index]),
      String(summary.tilted[index]),
      mostAndLast(100 * summary.peakDisplacement[index], 100 * summary.endDisplacement[index], 100 * thresholds.move),
      told,
      [...caveatsOf(summary.caveats[index]).map(({ name: caveat }) => caveat), world.statusText]
        .filter(Boolean)
        .join(", "),
    ];
  });
  const columns: Column[] = [
    { head: "acceleration" },
    { head: "pushed to", kind: "text" },
    { head: "verdict", kind: "text" },
    { head: "goes first", kind: "text name" },
    { head: "fallen" },
    { head: "moved" },
    { head: "tilted" },
    { head: "farthest, cm" },
    { head: "replicas", kind: "text", shown: rows.some((row) => row[8] !== "") },
    { head: "to know", kind: "text", shown: rows.some((row) => row[9] !== "") },
  ];
  const explained = [...caveats].map(
    ([name, meaning]) => `${capital(name)}: ${meaning.charAt(0).toLowerCase()}${meaning.slice(1)}`,
  );
  return [
    table(columns, rows, "wrap"),
    note(
      ["In brackets: at the end.", ...explained, NOT_MODELLED, ...(results.judgedAtEnd ? [JUDGED_AT_END] : [])].join(
        " ",
      ),
    ),
  ];
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
      // Larger ones than the largest that is sought are not known.
      value + 1e-6 < needed[i] && value < LARGEST_MARGIN ? bad(text(value)) : text(value),
      needed[i] > 0 ? `${Number(needed[i].toPrecision(3))} g` : "–",
      box > 0 ? boxName(world.boxes, box - 1) : "–",
    ];
  });
  const columns: Column[] = [
    { head: "pushed to" },
    { head: "in place", shown: margins.withinLimits !== null },
    { head: margins.withinLimits ? "within limits" : "in place" },
    { head: "needed" },
    { head: "goes first above", kind: "text name" },
  ];
  return part("How many g it stands", table(columns, rows));
}

function wallsTable(results: Results, worlds: readonly World[]): HTMLElement | null {
  const pressed = worlds.filter(({ walls }) => walls !== null);
  if (pressed.length === 0) return null;
  const { container, boxes } = worlds[0];
  const sides = UPRIGHT.filter((_, side) => container.openings.walls[side] > 0).map(({ name }) => name);
  const fixedBoxes = boxes.fixed.some((fixed) => fixed > 0) ? (["fixed boxes"] as const) : [];
  const rows = [...sides, ...fixedBoxes].flatMap((name): Cell[][] => {
    const at = PRESSED.indexOf(name);
    // A file of an earlier version does not have the force on fixed boxes.
    if (!pressed.some(({ walls }) => (walls?.lasting[at] ?? Number.NaN) >= 0)) return [];
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
  const columns = ["wall", "largest", "limit", "share"].map((head) => ({ head }));
  return part(
    `Force on the walls${norm === "" ? "" : `, limits of ${norm}`}`,
    table([...columns, { head: "under", kind: "text" }], rows),
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

function boxesTable(results: Results, found: readonly [number, World][], most: number): HTMLElement | null {
  if (found.length === 0) return null;
  const { thresholds } = results;
  const all = found[0][1].boxes;
  const rows = found.slice(0, most).map(([box, world]): Cell[] => {
    const { boxes } = world;
    const { peak, end } = boxes;
    const side = sidesLeft(results, world).get(box);
    return [
      String(boxes.id[box]),
      shortName(boxes.name[box]),
      sizeText([...boxes.size.subarray(3 * box, 3 * box + 3)]),
      weight(boxes.mass[box]),
      weight(boxes.bearingLimit[box]),
      mostAndLast(100 * peak.displacement[box], 100 * end.displacement[box], 100 * thresholds.move),
      mostAndLast(100 * peak.drop[box], 100 * end.drop[box], 100 * thresholds.drop),
      mostAndLast(peak.tilt[box], end.tilt[box], thresholds.tilt),
      when(boxes.firstBeyond[box]),
      underText(world),
      side === undefined ? "" : sideName(side),
    ];
  });
  const columns: Column[] = [
    { head: "box" },
    { head: "name", kind: "text name", shown: all.name.some((name) => name !== "") },
    { head: "size, cm" },
    { head: "mass, kg" },
    { head: "may bear, kg", shown: all.bearingLimit.some(Number.isFinite) },
    { head: "farthest, cm" },
    { head: "drop, cm" },
    { head: "tilt, °" },
    { head: "beyond from" },
    { head: "under", kind: "text" },
    { head: "leaves at", kind: "text", shown: rows.some((row) => row.at(-1) !== "") },
  ];
  const many = columns.filter(({ shown }) => shown !== false).length > FEW_COLUMNS;
  return part(
    "What went beyond a limit",
    table(columns, rows, many ? "many" : ""),
    moreBoxes(found.length - rows.length),
  );
}

/** Lines that margins and walls take, which stand beside each other: a heading, and the rows of the longer table. */
function linesBeside(parts: readonly (HTMLElement | null)[]): number {
  const rows = parts.map((part) => part?.querySelectorAll("tr").length ?? 0);
  return parts.some((part) => part) ? Math.max(LINES_OF_MARGINS, 1 + Math.max(...rows)) : 0;
}

/** Lines that caveats take beyond the first of a page: where a world has two, and where a second one is explained. */
function linesOfCaveats(caveats: readonly (readonly string[])[]): number {
  const wrapped = caveats.reduce((sum, own) => sum + Math.max(0, own.length - 1), 0);
  return wrapped + LINES_OF_CAVEAT * Math.max(0, new Set(caveats.flat()).size - 1);
}

/**
 * Rows of the tables that share the room of a page, evenly but for those that want fewer.
 * @param room lines, with those of the heads of tables
 * @param wanted rows of each table at most; 0: it is not there
 */
export function rowsFor(room: number, wanted: readonly number[]): number[] {
  const rows = wanted.map((most) => Math.min(LEAST_ROWS, most));
  const heads = LINES_OF_HEADS * wanted.filter((most) => most > 0).length;
  const left = room - heads - rows.reduce((sum, row) => sum + row, 0);
  for (let line = left >= 0 ? left : left + LINES_OF_SECOND_PAGE; line > 0; --line) {
    const growing = [...rows.keys()].filter((i) => rows[i] < wanted[i]);
    if (growing.length > 0) ++rows[growing.reduce((least, i) => (rows[i] < rows[least] ? i : least))];
  }
  return rows;
}

/** How the worlds ended, to the bit. */
const hashes = (worlds: readonly World[]) =>
  note(
    `${worlds[0].layout}, hashes of the ends: ${worlds.map(({ acceleration, stateHash }) => `${acceleration} ${stateHash}`).join(", ")}.`,
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
 * @param limited its boxes with a bearing limit
 */
export function loadSheet(
  results: Results,
  layout: number,
  worlds: readonly World[],
  limited: readonly LimitedBox[],
): HTMLElement {
  const simulated = worlds.filter(({ boxes }) => boxes.id.length > 0);
  const [world] = simulated;
  const title = element("h2", {}, results.layouts[layout]);
  if (!world) return element("section", {}, title, headline(worlds[0], worlds), ...worldsTable(results, worlds));
  const states = statesOf(simulated);
  const { size, openings } = world.container;
  const mats = matsSentence(world.boxes);
  const [left, end] = [departures(results, simulated), endViews(results, simulated)];
  const [margins, walls] = [marginsTable(results, layout, world), wallsTable(results, simulated)];
  const rooms = roomsOfViews(world.container);
  const room =
    LINES -
    linesBeside([margins, walls]) -
    (end ? LINES_OF_END : 0) -
    left.length -
    Math.max(0, worlds.length - 4) -
    linesOfCaveats(worlds.map(({ index }) => caveatsOf(results.worlds.caveats[index]).map(({ name }) => name))) +
    Math.floor((HIGHEST - rooms.top[1] - rooms.side[1]) / LINE_HEIGHT);
  const [beyond, items] = [farthestBoxes(simulated), toldItems(world.boxes)];
  const rows = rowsFor(room, [beyond.length, limited.length, items.length]);
  const sides = isClosed(openings, size[2]) ? null : openingsText(openings, size[2]);
  return element(
    "section",
    {},
    title,
    headline(world, worlds),
    ...views(world, states),
    colourKey(states, ["first to go under some acceleration", "beyond a limit", "stayed under all"]),
    mats === "" ? null : note(mats),
    sides ? note(`${capital(sides)}. The floor is dashed where no wall stands on it.`) : null,
    facts(results, world),
    ...worldsTable(results, worlds),
    ...left,
    end,
    element("div", { class: "beside" }, margins, walls),
    boxesTable(results, beyond, rows[0]),
    bearingTable(world.boxes, limited, rows[1]),
    itemsTable(items, world.boxes.id, rows[2]),
    hashes(simulated),
  );
}
