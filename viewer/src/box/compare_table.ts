import type { Results, World } from "../data/results";
import { isAtLeast, verdictText } from "../data/verdict";
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
  const number =
    (column: "fallen" | "moved" | "tilted" | "unstable") =>
    ({ results, world }: Shown) => {
      const boxes = results.worlds[column][world.index];
      return (boxes > 0 && isAtLeast(world.verdict, world.stopReason) ? "at least " : "") + count(boxes);
    };
  return element(
    "section",
    {},
    element("h2", {}, "Left and right"),
    element(
      "table",
      { class: "compare" },
      row("verdict", ({ world }) =>
        element(
          "span",
          {},
          element("i", { class: `dot verdict-${world.verdict}` }),
          verdictText(world.verdict, world.stopReason),
        ),
      ),
      shown.some(({ results }) => results.judgedAtEnd)
        ? row("judged at", ({ results }) => (results.judgedAtEnd ? "the end" : "any time"))
        : null,
      row("engine", ({ world }) => world.engine),
      row("fell", number("fallen")),
      row("moved", number("moved")),
      row("tilted", number("tilted")),
      row("unstable", number("unstable")),
      row("goes first, or nearest", ({ world }) => (world.criticalBox > 0 ? count(world.criticalBox) : "none")),
      row("largest displacement", ({ results, world }) => metres(results.worlds.peakDisplacement[world.index])),
      row("displacement at the end", ({ results, world }) => metres(results.worlds.endDisplacement[world.index])),
      row("largest kinetic energy", ({ results, world }) => joules(results.worlds.peakEnergy[world.index])),
    ),
  );
}
