import { element } from "./dom";

/** What the page shows before a file is there, and when one cannot be read. */
export function landing(message: string | null, choose: () => void): HTMLElement {
  return element(
    "main",
    { class: "landing" },
    element("h1", {}, "Which loadings hold?"),
    element("p", { class: "soft" }, "Drop a results file of holdfast here. It stays on this computer."),
    message ? element("p", { class: "problem", role: "alert" }, message) : null,
    element("button", { class: "primary", onclick: choose }, "Choose a file"),
    element("p", { class: "faint" }, "holdfast screen … -o results.h5 makes one."),
  );
}
