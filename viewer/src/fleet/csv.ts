import { CAVEAT_BITS, STATUS_BITS, STOP_REASON_CODES, VERDICT_CODES } from "../data/outcome";
import { NOT_COUNTED, type Results } from "../data/results";
import { csvBits, csvContainer, csvNumber, csvText } from "../save/csv_field";
import type { Row } from "./rows";

const boxes = (count: number) => (count === NOT_COUNTED ? "" : String(count));
const single = (value: number) => csvNumber(value, true);
const nameOf = (codes: Readonly<Record<string, number>>, code: number) =>
  Object.keys(codes).find((name) => codes[name] === code) ?? "";

/** One line per world of the rows, in their order, with the headings and the names of the program's worlds.csv. Names of boxes are by world. */
export function fleetCsv(results: Results, rows: readonly Row[], criticalNames: readonly string[] = []): string {
  const { worlds, judgedAtEnd } = results;
  const columns: [string, (world: number) => string][] = [
    ["layout", (world) => csvText(results.layouts[worlds.layout[world]])],
    ["acceleration", (world) => csvText(results.accelerations[worlds.acceleration[world]])],
    ["container", (world) => csvContainer(results.ownContainers.get(worlds.layout[world]))],
    ["verdict", (world) => nameOf(VERDICT_CODES, worlds.verdict[world])],
    ["judged_at", () => (judgedAtEnd ? "end" : "any_time")],
    ["status", (world) => csvBits(STATUS_BITS, worlds.status[world]) || "ok"],
    ["caveats", (world) => csvBits(CAVEAT_BITS, worlds.caveats[world])],
    ["stop_reason", (world) => nameOf(STOP_REASON_CODES, worlds.stopReason[world])],
    ["boxes", (world) => boxes(worlds.boxes[world])],
    ["fallen_boxes", (world) => boxes(worlds.fallen[world])],
    ["unstable_boxes", (world) => boxes(worlds.unstable[world])],
    ["moved_boxes", (world) => boxes(worlds.moved[world])],
    ["tilted_boxes", (world) => boxes(worlds.tilted[world])],
    ["fallen_at_end", (world) => boxes(worlds.fallenAtEnd[world])],
    ["critical_box", (world) => boxes(worlds.criticalBox[world])],
    ["critical_box_name", (world) => csvText(criticalNames[world] ?? "")],
    ["peak_displacement_m", (world) => single(worlds.peakDisplacement[world])],
    ["peak_drop_m", (world) => single(worlds.peakDrop[world])],
    ["peak_tilt_deg", (world) => single(worlds.peakTilt[world])],
    ["end_displacement_m", (world) => single(worlds.endDisplacement[world])],
    ["end_time_s", (world) => csvNumber(worlds.endTime[world], false)],
  ];
  const lines = [columns.map(([heading]) => heading).join(",")];
  for (const row of rows)
    for (const world of row.worlds) if (world >= 0) lines.push(columns.map(([, value]) => value(world)).join(","));
  return `${lines.join("\n")}\n`;
}
