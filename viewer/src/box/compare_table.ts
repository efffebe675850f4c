import type { Results, World } from "../data/results";
import { VERDICTS } from "../data/verdict";
import { element } from "../ui/dom";
import { count, joules, metres } from "../ui/text";

/** A world with the file that it is from. */
export interface Shown {
  results: Results;
  world: World;
}

/** The numbers of two worlds side by side. */
export function compareTable(shown: readonly Shown[]): HTMLElement {
  const row = (name: string, value: (of: Shown) => string | HTMLElement) =>
    element("tr", {}, element("th", { scope: "row" }, name), ...shown.map((of) => element("td", {}, value(of))));
  const number = (column: "fallen" | "moved" | "tilted" | "unstable") => (of: Shown) =>
    count(of.results.worlds[column][of.world.index]);
  return element(
    "section",
    {},
    element("h2", {}, "Left and right"),
    element(
      "table",
      { class: "compare" },
      row("verdict", ({ world }) =>
        element("span", {}, element("i", { class: `dot verdict-${world.verdict}` }), VERDICTS[world.verdict].name),
      ),
      row("engine", ({ world }) => world.engine),
      row("fallen", number("fallen")),
      row("moved", number("moved")),
      row("tilted", number("tilted")),
      row("unstable", number("unstable")),
      row("displacement at the end", ({ results, world }) => metres(results.worlds.displacement[world.index])),
      row("largest kinetic energy", ({ results, world }) => joules(results.worlds.peakEnergy[world.index])),
    ),
  );
}
