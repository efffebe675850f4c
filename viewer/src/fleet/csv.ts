import type { Results } from "../data/results";
import { VERDICTS } from "../data/verdict";
import type { Row } from "./rows";

const NOT_SIMULATED = 0xffffffff;

const quoted = (text: string) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const number = (value: number) => (Number.isNaN(value) || value === NOT_SIMULATED ? "" : String(value));

/** One line per world of the rows, in their order. */
export function fleetCsv(results: Results, rows: readonly Row[]): string {
  const { worlds } = results;
  const lines = [
    "layout,acceleration,verdict,boxes,fallen,moved,tilted,unstable,max_displacement_m,peak_displacement_m,status",
  ];
  for (const row of rows)
    for (const world of row.worlds) {
      if (world < 0) continue;
      lines.push(
        [
          quoted(results.layouts[row.layout]),
          quoted(results.accelerations[worlds.acceleration[world]]),
          VERDICTS[worlds.verdict[world]].name,
          number(worlds.boxes[world]),
          number(worlds.fallen[world]),
          number(worlds.moved[world]),
          number(worlds.tilted[world]),
          number(worlds.unstable[world]),
          number(worlds.displacement[world]),
          number(worlds.peakDisplacement[world]),
          String(worlds.status[world]),
        ].join(","),
      );
    }
  return `${lines.join("\n")}\n`;
}
