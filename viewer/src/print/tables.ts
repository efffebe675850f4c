import { element } from "../ui/dom";
import { fixed, plural, seconds } from "../ui/text";

/** Tables of the printed page of a load, and the texts in them. */

export type Cell = string | HTMLElement;

/** kg, with a digit behind the point where it says something. */
export const weight = (mass: number) => (Number.isFinite(mass) ? fixed(mass, mass >= 100 ? 0 : 1) : "–");
/** The shortest number, of a limit that somebody has set. */
export const short = (value: number) => String(Number(value.toPrecision(6)));

export const bad = (text: string) => element("span", { class: "bad" }, text);
export const note = (...parts: Cell[]) => element("p", { class: "note" }, ...parts);

export interface Column {
  head: string;
  /** a text, or one that may take several lines; a number where it is not given, but in the first column */
  kind?: "text" | "text name";
  /** false: it has nothing to say */
  shown?: boolean;
}

/** @param kind class of the table in the style */
export function table(columns: readonly Column[], rows: readonly (readonly Cell[])[], kind = ""): HTMLElement {
  const kept = columns.flatMap(({ shown }, i) => (shown === false ? [] : [i]));
  const row = (tag: "th" | "td", cells: readonly Cell[]) =>
    element("tr", {}, ...kept.map((i) => element(tag, { class: columns[i].kind }, cells[i])));
  const heads = columns.map(({ head }) => head);
  return element(
    "table",
    { class: kind || undefined },
    heads.some((head) => head !== "") ? row("th", heads) : null,
    ...rows.map((cells) => row("td", cells)),
  );
}

/** A part of a page with a heading, which a break of the page does not cut in two. */
export const part = (title: string, ...children: (HTMLElement | null)[]): HTMLElement =>
  element("div", { class: "part" }, element("h3", {}, title), ...children);

/** How many boxes a table leaves out. */
export const moreBoxes = (number: number): HTMLElement | null =>
  number > 0 ? element("p", {}, `and ${plural(number, "more box")}`) : null;

export const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** A number beside a limit, with as many digits as it takes to see whether it is beyond. */
export function besideLimit(value: number, limit: number): string {
  if (!Number.isFinite(value)) return "–";
  const texts = [0, 1, 2, 3].map((digits) => fixed(value, digits));
  return texts.find((text) => Number(text) > limit === value > limit) ?? texts[3];
}

/** A number at its largest, and in brackets at the end, beside its limit. */
export const mostAndLast = (most: number, last: number, limit: number) =>
  `${besideLimit(most, limit)} (${besideLimit(last, limit)})`;

/** When a box was beyond a limit first. */
export const when = (time: number) => (Number.isNaN(time) ? "–" : time >= 0 ? seconds(time) : "settling");

/** The first of several, and how many there are more. */
export const listed = (texts: readonly string[], most: number, between = ", ") =>
  texts.slice(0, most).join(between) + (texts.length > most ? ` and ${texts.length - most} more` : "");

/** Boxes by their numbers: "boxes 1, 2 and 3 more". */
export const numbersText = (numbers: readonly number[], most: number) =>
  `${numbers.length === 1 ? "box" : "boxes"} ${listed(numbers.map(String), most)}`;
