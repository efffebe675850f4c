import { element } from "./dom";

const KEYS: readonly [string, string][] = [
  ["space", "play, pause"],
  ["← →", "sample by sample"],
  ["shift ← →", "to the next, previous time at which a box is beyond a limit first"],
  ["home, end", "begin, end"],
  ["1 … 6", "whole, left, right, top, front, door"],
  ["F", "look at the chosen box"],
  ["N, P", "next, previous world that does not hold"],
  ["M", "matrix of all worlds"],
  ["X", "compare with another world"],
  ["E", "mend the load, where it was screened in this page"],
  ["L", "live: drive the world in the engine of this page"],
  ["G, T, C", "ghost, traces, centre of gravity"],
  ["ctrl P", "a page to print, of the open load or of all that are shown"],
  ["S", "picture, PNG at twice the size"],
  ["V", "video, WebM"],
  ["escape", "choose no box; back to the matrix"],
  ["?", "this list"],
];

const LIVE: readonly [string, string][] = [
  ["space, .", "run or pause; a single step"],
  ["R", "reset: before it started; again: layout and settings of the file"],
  ["B", "replay the file's world: are these its bits?"],
  ["← →, ↑ ↓", "push the load along, across, by 0.1 g"],
  ["page up, down", "push the load up, down"],
  ["0", "push it no more"],
  ["shift arrows", "push the chosen box; at the start, move it by 1 cm"],
];

const list = (keys: readonly [string, string][]) =>
  element(
    "dl",
    {},
    ...keys.flatMap(([key, what]) => [element("dt", {}, element("kbd", {}, key)), element("dd", {}, what)]),
  );

/** The list of keys. */
export function helpDialog(): HTMLDialogElement {
  const dialog = element(
    "dialog",
    { class: "help", "aria-label": "Keys", onclick: () => dialog.close() },
    element("h2", {}, "Keys"),
    list(KEYS),
    element("h2", {}, "Live"),
    list(LIVE),
    element(
      "p",
      { class: "faint" },
      "In the matrix arrows move and Enter opens. Drag turns the load, the wheel comes nearer, a double click looks at a box.",
    ),
  );
  return dialog;
}
