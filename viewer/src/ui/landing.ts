import { element } from "./dom";

/** What the page shows before a file is there, and when one cannot be read. */
export function landing(message: string | null, choose: () => void): HTMLElement {
  return element(
    "main",
    { class: "landing" },
    element("h1", {}, "Which loadings hold?"),
    element(
      "p",
      { class: "soft" },
      "Drop a spreadsheet with the boxes of your loads here, or the export of a load planner: .xlsx, .csv, .json, .txt. " +
        "Results files of holdfast open too. Everything stays on this computer.",
    ),
    message ? element("p", { class: "problem", role: "alert" }, message) : null,
    element("button", { class: "primary", onclick: choose }, "Choose files"),
    element(
      "p",
      { class: "faint" },
      "A row per box: its place x, y, z and its length, width and height, in any order.",
    ),
  );
}
