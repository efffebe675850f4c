import { CAVEAT_BITS, STATUS_BITS, STOP_REASON_CODES, VERDICT_CODES } from "../data/outcome";
import { type Container, NOT_COUNTED, type Results } from "../data/results";
import { namesOf } from "../data/status";
import type { Row } from "./rows";

/** A text as a field; what a spreadsheet would take for a formula begins with an apostrophe. */
function quoted(text: string): string {
  const formula = /^[=+\-@\t\r]/.test(text);
  return formula || /[",\r\n]/.test(text) ? `"${formula ? "'" : ""}${text.replaceAll('"', '""')}"` : text;
}
const number = (value: number) => (Number.isNaN(value) || value === NOT_COUNTED ? "" : String(value));
const nameOf = (codes: Readonly<Record<string, number>>, code: number) =>
  Object.keys(codes).find((name) => codes[name] === code) ?? "";

/** Type or size of a load's own container; nothing where it is that of the run. */
const containerText = (own: Container | undefined) => own?.type || (own ? `${own.size.join(" x ")} m` : "");

/** One line per world of the rows, in their order, with the headings and the names of the program's worlds.csv. Names of boxes are by world. */
export function fleetCsv(results: Results, rows: readonly Row[], criticalNames: readonly string[] = []): string {
  const { worlds, judgedAtEnd } = results;
  const columns: [string, (world: number) => string][] = [
    ["layout", (world) => quoted(results.layouts[worlds.layout[world]])],
    ["acceleration", (world) => quoted(results.accelerations[worlds.acceleration[world]])],
    ["container", (world) => quoted(containerText(results.ownContainers.get(worlds.layout[world])))],
    ["verdict", (world) => nameOf(VERDICT_CODES, worlds.verdict[world])],
    ["judged_at", () => (judgedAtEnd ? "end" : "any_time")],
    ["status", (world) => namesOf(STATUS_BITS, worlds.status[world]).join("+") || "ok"],
    ["caveats", (world) => namesOf(CAVEAT_BITS, worlds.caveats[world]).join("+")],
    ["stop_reason", (world) => nameOf(STOP_REASON_CODES, worlds.stopReason[world])],
    ["boxes", (world) => number(worlds.boxes[world])],
    ["fallen_boxes", (world) => number(worlds.fallen[world])],
    ["unstable_boxes", (world) => number(worlds.unstable[world])],
    ["moved_boxes", (world) => number(worlds.moved[world])],
    ["tilted_boxes", (world) => number(worlds.tilted[world])],
    ["fallen_at_end", (world) => number(worlds.fallenAtEnd[world])],
    ["critical_box", (world) => number(worlds.criticalBox[world])],
    ["critical_box_name", (world) => quoted(criticalNames[world] ?? "")],
    ["peak_displacement_m", (world) => number(worlds.peakDisplacement[world])],
    ["peak_drop_m", (world) => number(worlds.peakDrop[world])],
    ["peak_tilt_deg", (world) => number(worlds.peakTilt[world])],
    ["end_displacement_m", (world) => number(worlds.endDisplacement[world])],
    ["end_time_s", (world) => number(worlds.endTime[world])],
  ];
  const lines = [columns.map(([heading]) => heading).join(",")];
  for (const row of rows)
    for (const world of row.worlds) if (world >= 0) lines.push(columns.map(([, value]) => value(world)).join(","));
  return `${lines.join("\n")}\n`;
}
