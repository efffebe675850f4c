import type { Results, World } from "../data/results";
import { failing, verdictText } from "../data/verdict";
import { element } from "../ui/dom";
import { plural } from "../ui/text";
import { findBearing } from "./bearing";
import { loadSheet, runFacts } from "./sheet";

/** Loads that get a page, at most. */
const MOST_PAGES = 50;

/** The page before those of loads: how the run was made, and what fails under what. */
function frontPage(results: Results, layouts: readonly number[]): HTMLElement {
  const { worlds, accelerations } = results;
  const failures = new Map<number, string[]>();
  for (const [world, layout] of worlds.layout.entries()) {
    const verdict = worlds.verdict[world];
    if (!failing(verdict)) continue;
    const text = `${accelerations[worlds.acceleration[world]]}: ${verdictText(verdict, worlds.stopReason[world])}`;
    failures.set(layout, [...(failures.get(layout) ?? []), text]);
  }
  const row = (tag: "td" | "th", cells: readonly string[]) =>
    element("tr", {}, ...cells.map((cell) => element(tag, { class: "text" }, cell)));
  const failed = layouts.filter((layout) => failures.has(layout)).length;
  const more = layouts.length > MOST_PAGES ? ` The first ${MOST_PAGES} have a page here.` : "";
  const told =
    failed === 0
      ? "All loads hold."
      : `${failed} of ${plural(layouts.length, "load")} ${failed === 1 ? "does" : "do"} not hold.`;
  return element(
    "section",
    {},
    element("h1", {}, results.name),
    element("p", {}, told + more),
    element("table", { class: "wrap" }, ...runFacts(results).map((fact) => row("td", fact))),
    element(
      "table",
      { class: "wrap" },
      row("th", ["load", "fails under"]),
      ...layouts.map((layout) => row("td", [results.layouts[layout], failures.get(layout)?.join(", ") ?? "holds"])),
    ),
  );
}

/** Brings pages of loads onto paper: they are in the document, out of sight, while it is printed. */
export class Printed {
  readonly node = element("div", { class: "report" });

  /** What is printed while no pages of loads are asked for: by the menu of the browser. */
  overview(results: Results, layouts: readonly number[]): void {
    this.node.replaceChildren(frontPage(results, layouts));
  }

  clear(): void {
    this.node.replaceChildren();
  }

  /**
   * Makes the pages of layouts, and asks the browser to print them.
   * @param world reads a world by its index
   */
  async print(results: Results, layouts: readonly number[], world: (index: number) => Promise<World>): Promise<void> {
    const sheets: HTMLElement[] = [];
    for (const layout of layouts.slice(0, MOST_PAGES)) {
      const worlds: World[] = [];
      for (const [index, of] of results.worlds.layout.entries()) if (of === layout) worlds.push(await world(index));
      if (worlds.length === 0) continue;
      const simulated = worlds.find(({ boxes }) => boxes.id.length > 0);
      const limited = simulated ? await findBearing(results, simulated) : [];
      sheets.push(loadSheet(results, layout, worlds, limited));
    }
    const front = layouts.length > 1 ? [frontPage(results, layouts)] : [];
    this.node.replaceChildren(...front, ...sheets);
    print();
  }
}
