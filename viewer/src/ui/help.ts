import { element } from "./dom";

const KEYS: readonly [string, string][] = [
  ["space", "play, pause"],
  ["← →", "sample by sample"],
  ["shift ← →", "from first move to first move"],
  ["home, end", "begin, end"],
  ["1 … 6", "whole, left, right, top, front, door"],
  ["F", "look at the chosen box"],
  ["N, P", "next, previous world that does not hold"],
  ["M", "matrix of all worlds"],
  ["X", "compare with another world"],
  ["G, T, C", "ghost, traces, centre of gravity"],
  ["S", "picture, PNG at twice the size"],
  ["V", "video, WebM"],
  ["escape", "choose no box; back to the matrix"],
  ["?", "this list"],
];

/** The list of keys. */
export function helpDialog(): HTMLDialogElement {
  const dialog = element(
    "dialog",
    { class: "help", "aria-label": "Keys", onclick: () => dialog.close() },
    element("h2", {}, "Keys"),
    element(
      "dl",
      {},
      ...KEYS.flatMap(([key, what]) => [element("dt", {}, element("kbd", {}, key)), element("dd", {}, what)]),
    ),
    element(
      "p",
      { class: "faint" },
      "In the matrix arrows move and Enter opens. Drag turns the load, the wheel comes nearer, a double click looks at a box.",
    ),
  );
  return dialog;
}
