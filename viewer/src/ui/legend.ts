import { element } from "./dom";
import { isDark } from "./theme";

/** A line of a legend: a colour, or a scale from pale to strong. */
export type LegendEntry = { fill: string; label: string } | { from: string; to: string };

/** From pale to strong, as a share of 0 to 1. */
export function ramp(share: number): string {
  const at = Math.min(1, Math.max(0, share));
  // One hue, from near the background to far from it.
  const lightness = isDark() ? 24 + 48 * at : 95 - 52 * at;
  // With commas: three reads no other form.
  return `hsl(${214 - 10 * at}, ${28 + 34 * at}%, ${lightness}%)`;
}

/** The lines of a legend, for a list of the class `colours`. */
export const legendItems = (entries: readonly LegendEntry[]): HTMLElement[] =>
  entries.map((entry) =>
    "fill" in entry
      ? element("li", {}, element("i", { style: `background: ${entry.fill}` }), entry.label)
      : element(
          "li",
          {},
          entry.from,
          element("i", {
            class: "ramp",
            style: `background: linear-gradient(90deg, ${[0, 0.25, 0.5, 0.75, 1].map(ramp).join(", ")})`,
          }),
          entry.to,
        ),
  );
