import { VERDICT_CODES } from "../data/outcome";
import type { Results } from "../data/results";
import { isAtLeast, VERDICTS } from "../data/verdict";
import { colour, isDark, verdictColour } from "../ui/theme";
import { DIRECTIONS, judgedDisplacements, judgedMargins, type Row, type Scale } from "./rows";

/** How a cell of the matrix looks: null where there is nothing. */
export interface Cell {
  fill: string;
  ink: string;
  text: string;
}

/** From pale to strong, as a share of 0 to 1. */
export function ramp(share: number): string {
  const at = Math.min(1, Math.max(0, share));
  // One hue, from near the background to far from it.
  const lightness = isDark() ? 24 + 48 * at : 95 - 52 * at;
  // With commas: three reads no other form.
  return `hsl(${214 - 10 * at}, ${28 + 34 * at}%, ${lightness}%)`;
}
const rampInk = (share: number) => (share > 0.55 ? (isDark() ? "#10151c" : "#fff") : colour("ink"));

/** Displacements are compared over four decades: 1 mm is nothing, 10 m is everything. */
export const displacementShare = (metres: number) => Math.max(0, Math.log10(Math.max(metres, 1e-3)) + 3) / 4;
/** Loads are asked to stand up to 1 g. */
export const marginShare = (g: number) => 1 - Math.min(1, Math.max(0, g));

function verdictCell(results: Results, world: number): Cell {
  const { worlds } = results;
  const verdict = worlds.verdict[world];
  const number =
    verdict === VERDICT_CODES.fell
      ? worlds.fallen[world]
      : verdict === VERDICT_CODES.unstable
        ? worlds.unstable[world]
        : verdict === VERDICT_CODES.moved
          ? Math.max(worlds.moved[world], worlds.tilted[world])
          : 0;
  const glyph = VERDICTS[verdict].glyph;
  const least = isAtLeast(verdict, worlds.stopReason[world]) ? "≥ " : "";
  return {
    fill: verdictColour(verdict),
    ink: colour(`verdict-ink-${verdict}`),
    text: number > 0 ? `${glyph} ${least}${number}` : glyph,
  };
}

function valueCell(value: number, share: number, digits: number): Cell | null {
  if (!Number.isFinite(value)) return null;
  return { fill: ramp(share), ink: rampInk(share), text: value.toFixed(digits) };
}

/** Whether the cells of a scale are of layouts, not of worlds. */
export const isOfMargins = (scale: Scale) => scale === "margin" || scale === "place";

/** The cell of a column; columns are accelerations, or directions for margins. */
export function cellOf(results: Results, row: Row, column: number, scale: Scale): Cell | null {
  if (isOfMargins(scale)) {
    const { margins } = results;
    if (!margins) return null;
    const { margin } = scale === "place" ? margins.inPlace : judgedMargins(margins);
    const value = margin[4 * row.layout + column];
    return valueCell(value, marginShare(value), 2);
  }
  const world = row.worlds[column];
  if (world < 0) return null;
  if (scale === "displacement") {
    const displacement = judgedDisplacements(results)[world];
    return valueCell(displacement, displacementShare(displacement), 2);
  }
  if (scale === "share") {
    const share = results.replicas?.share[world] ?? Number.NaN;
    return valueCell(share, share, 2);
  }
  return verdictCell(results, world);
}

export const columnNames = (results: Results, scale: Scale): readonly string[] =>
  isOfMargins(scale) ? DIRECTIONS : results.accelerations;

/** Scales that the file has numbers for. */
export function scalesOf(results: Results): { value: Scale; label: string }[] {
  const scales: { value: Scale; label: string }[] = [
    { value: "verdict", label: "verdict" },
    {
      value: "displacement",
      label: results.judgedAtEnd ? "displacement at the end, m" : "largest displacement, m",
    },
  ];
  if (results.margins?.withinLimits) scales.push({ value: "margin", label: "margin within the limits, g" });
  if (results.margins) scales.push({ value: "place", label: "margin in place, g" });
  if (results.replicas) scales.push({ value: "share", label: "share of replicas that fail" });
  return scales;
}
