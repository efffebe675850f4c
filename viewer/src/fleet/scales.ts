import { type HardestWalls, NOT_COUNTED, type Results } from "../data/results";
import { isAtLeast, VERDICTS } from "../data/verdict";
import { type LegendEntry, ramp } from "../ui/legend";
import { fixed, marginNumber, newtons, percent } from "../ui/text";
import { colour, isDark, verdictColour } from "../ui/theme";
import { DIRECTIONS, goneBoxes, judgedDisplacements, judgedMargins, type Row, type Scale } from "./rows";

/** How a cell of the matrix looks: null where there is nothing. */
export interface Cell {
  fill: string;
  ink: string;
  text: string;
}

const rampInk = (share: number) => (share > 0.55 ? (isDark() ? "#10151c" : "#fff") : colour("ink"));

/** Displacements are compared over four decades: 1 mm is nothing, 10 m is everything. */
export const displacementShare = (metres: number) => Math.max(0, Math.log10(Math.max(metres, 1e-3)) + 3) / 4;
/** Loads are asked to stand up to 1 g. */
export const marginShare = (g: number) => 1 - Math.min(1, Math.max(0, g));

/** Boxes are compared over two decades; a single one stands out from none. */
export const countShare = (boxes: number) => (boxes > 0 ? Math.min(1, 0.4 + 0.3 * Math.log10(boxes)) : 0);

/** The force on the side of a world that is pressed hardest, as text, and as a share of 0 to 1 for its colour. */
function wallCell({ force, share, most, norm }: HardestWalls, world: number): Cell | null {
  if (norm !== "") return valueCell(share[world], share[world], percent(share[world]));
  return valueCell(force[world], force[world] / (most || 1), fixed(force[world] / 1000, 1));
}

function verdictCell(results: Results, world: number): Cell {
  const { worlds } = results;
  const verdict = worlds.verdict[world];
  const number = goneBoxes(results, world);
  const glyph = VERDICTS[verdict].glyph;
  const least = isAtLeast(verdict, worlds.stopReason[world]) ? "≥ " : "";
  return {
    fill: verdictColour(verdict),
    ink: colour(`verdict-ink-${verdict}`),
    text: number > 0 ? `${glyph} ${least}${number}` : glyph,
  };
}

function valueCell(value: number, share: number, text = fixed(value, 2)): Cell | null {
  if (!Number.isFinite(value)) return null;
  return { fill: ramp(share), ink: rampInk(share), text };
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
    return valueCell(value, marginShare(value), marginNumber(value));
  }
  const world = row.worlds[column];
  if (world < 0) return null;
  if (scale === "displacement") {
    const displacement = judgedDisplacements(results)[world];
    return valueCell(displacement, displacementShare(displacement));
  }
  if (scale === "share") {
    const share = results.replicas?.share[world] ?? Number.NaN;
    return valueCell(share, share);
  }
  if (scale === "damage") {
    const boxes = results.damage?.boxesBeyond[world] ?? NOT_COUNTED;
    return boxes === NOT_COUNTED ? null : valueCell(boxes, countShare(boxes), String(boxes));
  }
  if (scale === "walls") return results.hardestWalls ? wallCell(results.hardestWalls, world) : null;
  return verdictCell(results, world);
}

export const columnNames = (results: Results, scale: Scale): readonly string[] =>
  isOfMargins(scale) ? DIRECTIONS : results.accelerations;

/** What the colours of a scale say; those of verdicts stand beside the matrix with their numbers. */
export function scaleLegend(scale: Scale, results: Results): LegendEntry[] {
  const { norm, most } = results.hardestWalls ?? { norm: "", most: 0 };
  if (scale === "verdict") return [];
  const ends: Record<Exclude<Scale, "verdict">, { from: string; to: string }> = {
    displacement: { from: "1 mm or less", to: "10 m or more, each tenfold alike" },
    margin: { from: "1 g or more", to: "0 g, or unstable" },
    place: { from: "1 g or more", to: "0 g, or unstable" },
    share: { from: "0, none fails", to: "1, all fail" },
    damage: { from: "no box", to: "100 boxes or more, each tenfold alike" },
    walls: norm !== "" ? { from: "0 %", to: `100 % of ${norm}, or more` } : { from: "0 kN", to: newtons(most) },
  };
  return [ends[scale], { fill: colour("hollow"), label: "not known" }];
}

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
  if (results.damage) scales.push({ value: "damage", label: "boxes beyond the damage boundary" });
  if (results.hardestWalls) {
    const { norm } = results.hardestWalls;
    scales.push({ value: "walls", label: norm !== "" ? `force on walls, share of ${norm}` : "force on walls, kN" });
  }
  return scales;
}
