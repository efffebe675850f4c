import { VERDICT_CODES } from "../data/outcome";
import { type MarginColumns, type Margins, PENDING, type Results } from "../data/results";
import { VERDICTS } from "../data/verdict";

export type Sort = "worst" | "margin" | "name";
export type Scale = "verdict" | "displacement" | "margin" | "place" | "share" | "damage" | "walls";

export const DIRECTIONS = ["front", "rear", "left", "right"] as const;

/** The displacements that worlds are judged by: the largest ones, or in a file of an earlier version those at the end. */
export const judgedDisplacements = ({ judgedAtEnd, worlds }: Results): Float32Array =>
  judgedAtEnd ? worlds.endDisplacement : worlds.peakDisplacement;

/** The margins that layouts are judged by: within the limits, as worlds are; an earlier version has only those in place. */
export const judgedMargins = ({ inPlace, withinLimits }: Margins): MarginColumns => withinLimits ?? inPlace;

/** A layout and its worlds, one per acceleration; -1 where the file has none. */
export interface Row {
  layout: number;
  worlds: Int32Array;
  /** of its worst world */
  badness: number;
  /** boxes that went beyond a limit in the worlds with each verdict of `WORST`, in that order: sums of the numbers in its cells */
  failing: number[];
  /** m, the largest of its worlds */
  displacement: number;
  /** g, smallest of the four directions; NaN where it is not known */
  margin: number;
}

/** Codes of the verdicts of worlds that do not hold, the worst one first. */
const WORST = VERDICTS.map((_, code) => code)
  .filter((code) => VERDICTS[code].fails)
  .sort((a, b) => VERDICTS[b].badness - VERDICTS[a].badness);

/** Which of two rows has more boxes of the worst verdict, or of the next one where they have as many. */
const byFailing = (a: Row, b: Row) => b.failing.map((count, i) => count - a.failing[i]).find((more) => more !== 0) ?? 0;

/** How many boxes were beyond the limit that decided a world's verdict. */
export function goneBoxes({ worlds }: Results, world: number): number {
  const { fell, unstable, moved } = VERDICT_CODES;
  const verdict = worlds.verdict[world];
  if (verdict === fell) return worlds.fallen[world];
  if (verdict === unstable) return worlds.unstable[world];
  return verdict === moved ? Math.max(worlds.moved[world], worlds.tilted[world]) : 0;
}

export function rowsOf(results: Results): Row[] {
  const { worlds, layouts, accelerations, margins } = results;
  const rows: Row[] = layouts.map((_, layout) => ({
    layout,
    worlds: new Int32Array(accelerations.length).fill(-1),
    badness: -1,
    failing: WORST.map(() => 0),
    displacement: 0,
    margin: margins ? smallest(judgedMargins(margins).margin.subarray(4 * layout, 4 * layout + 4)) : Number.NaN,
  }));
  const displacements = judgedDisplacements(results);
  for (let world = 0; world < worlds.layout.length; ++world) {
    const row = rows[worlds.layout[world]];
    if (!row || worlds.verdict[world] === PENDING) continue;
    row.worlds[worlds.acceleration[world]] = world;
    row.badness = Math.max(row.badness, VERDICTS[worlds.verdict[world]]?.badness ?? 0);
    const failure = WORST.indexOf(worlds.verdict[world]);
    if (failure >= 0) row.failing[failure] += goneBoxes(results, world);
    if (displacements[world] > row.displacement) row.displacement = displacements[world];
  }
  return rows;
}

function smallest(values: Float64Array): number {
  const known = values.filter((value) => !Number.isNaN(value));
  return known.length > 0 ? Math.min(...known) : Number.NaN;
}

const collator = new Intl.Collator("en", { numeric: true });

/** What each order is, in words. */
export const ORDERS: Record<Sort, string> = {
  worst:
    "By how many boxes are unstable, then by how many fell, then by how many moved, under all accelerations together.",
  margin: "By the smallest margin of the four directions, the one that layouts are judged by.",
  name: "By the names of the layouts.",
};

/** Rows whose layout has all words of the filter in its name, in the order asked for. */
export function arranged(rows: readonly Row[], names: readonly string[], filter: string, sort: Sort): Row[] {
  const words = filter.toLowerCase().split(/\s+/).filter(Boolean);
  const kept = rows.filter((row) => {
    const name = names[row.layout].toLowerCase();
    return words.every((word) => name.includes(word));
  });
  const byName = (a: Row, b: Row) => collator.compare(names[a.layout], names[b.layout]);
  const unknownLast = (margin: number) => (Number.isNaN(margin) ? Number.POSITIVE_INFINITY : margin);
  const orders: Record<Sort, (a: Row, b: Row) => number> = {
    worst: (a, b) => byFailing(a, b) || b.badness - a.badness || b.displacement - a.displacement || byName(a, b),
    margin: (a, b) => unknownLast(a.margin) - unknownLast(b.margin) || byName(a, b),
    name: byName,
  };
  // Infinity - Infinity is NaN, which `||` takes as equal.
  return kept.sort(orders[sort]);
}

/** Worlds by verdict. */
export function verdictCounts(results: Results): number[] {
  const counts = VERDICTS.map(() => 0);
  for (const verdict of results.worlds.verdict) if (verdict !== PENDING) counts[verdict] += 1;
  return counts;
}
