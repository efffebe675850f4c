import { boxText } from "../box/box_text";
import { VERDICT_CODES } from "../data/outcome";
import type { Results, World } from "../data/results";
import { VERDICTS } from "../data/verdict";
import { DIRECTIONS, judgedMargins } from "../fleet/rows";
import { type LegendEntry, ramp } from "../ui/legend";
import { degrees, kilograms, margin, metres, seconds } from "../ui/text";
import { colour, isDark } from "../ui/theme";
import { boxVerdict, damageIndices, speedsAt, tiltsAt } from "./quantities";

/** What the colour of a box says. */
export type Colouring =
  | "verdict"
  | "displacement"
  | "speed"
  | "tilt"
  | "material"
  | "mass"
  | "margin"
  | "first"
  | "damage";

export interface Painted {
  /** one CSS colour per box */
  fills: string[];
  legend: LegendEntry[];
  /** whether the colours change with time */
  moving: boolean;
}

const MATERIALS = ["#8aa5bd", "#c8a97e", "#93b08f", "#b79ab5", "#c99787", "#a7a58a", "#86b0ae", "#b0a0c4"];

export function colouringsOf(results: Results, world: World): { value: Colouring; label: string }[] {
  const list: { value: Colouring; label: string }[] = [
    { value: "verdict", label: "verdict" },
    { value: "displacement", label: "displacement" },
  ];
  if (world.series) list.push({ value: "speed", label: "speed" });
  list.push({ value: "tilt", label: "tilt" });
  if (!results.judgedAtEnd) list.push({ value: "first", label: "first beyond a limit" });
  list.push({ value: "material", label: "material" }, { value: "mass", label: "mass" });
  if (world.boxes.damage) list.push({ value: "damage", label: "damage" });
  if (results.margins) list.push({ value: "margin", label: "critical for a margin" });
  return list;
}

/** Colour of a box that is part of the container. */
const FIXED = { light: "#9b9ea4", dark: "#737880" };

/** Colour of a box that nothing happens to. */
export const calm = () => (isDark() ? "#47505a" : "#dcdfdd");

const paintVerdict = ({ boxes }: World): Painted => {
  const { stayed, unstable, fell, moved } = VERDICT_CODES;
  const verdicts = Array.from(boxes.id, (_, box) => boxVerdict(boxes, box));
  const shown = [stayed, unstable, fell, moved].filter((code) =>
    verdicts.some((verdict, box) => verdict === code && !boxes.fixed[box]),
  );
  const fill = (code: number) => (code === stayed ? calm() : colour(`verdict-${code}`));
  return {
    fills: verdicts.map(fill),
    legend: shown.map((code) => ({ fill: fill(code), label: VERDICTS[code].name })),
    moving: false,
  };
};

function paintScale(
  values: ArrayLike<number>,
  most: number,
  ends: { from: string; to: string },
  moving: boolean,
): Painted {
  return {
    fills: Array.from(values, (value) => (value >= 0 ? ramp(value / most) : calm())),
    legend: [ends],
    moving,
  };
}

/** The colours of all boxes at a time. `distance` is how far each is then, m. */
export function paint(
  colouring: Colouring,
  results: Results,
  world: World,
  time: number,
  distance: ArrayLike<number>,
): Painted {
  const painted = paintLoad(colouring, results, world, time, distance);
  const { fixed } = world.boxes;
  if (!fixed.includes(1)) return painted;
  const fill = isDark() ? FIXED.dark : FIXED.light;
  return {
    ...painted,
    fills: painted.fills.map((of, box) => (fixed[box] ? fill : of)),
    legend: [...painted.legend, { fill, label: "fixed" }],
  };
}

/** The same, as if no box were part of the container. */
function paintLoad(
  colouring: Colouring,
  results: Results,
  world: World,
  time: number,
  distance: ArrayLike<number>,
): Painted {
  const { boxes } = world;
  const count = boxes.id.length;
  const { move, tilt } = results.thresholds;
  // Scales end at twice the limit of the verdict: what is beyond it stands out.
  switch (colouring) {
    case "displacement":
      return paintScale(distance, 2 * move, { from: "0 cm", to: `${metres(2 * move)} or more` }, true);
    case "speed": {
      const speed = new Float32Array(count);
      speedsAt(world, time, speed);
      return paintScale(speed, 1, { from: "0 m/s", to: "1 m/s or more" }, true);
    }
    case "tilt": {
      const angle = new Float32Array(count);
      tiltsAt(world, time, angle);
      return paintScale(angle, 2 * tilt, { from: "0°", to: `${degrees(2 * tilt)} or more` }, true);
    }
    case "mass": {
      // 1 kg where all boxes are fixed, and none is coloured by it.
      const most = boxes.mass.reduce((sofar, mass, box) => (boxes.fixed[box] ? sofar : Math.max(sofar, mass)), 0) || 1;
      return paintScale(boxes.mass, most, { from: "0 kg", to: kilograms(most) }, false);
    }
    case "material": {
      const order = new Intl.Collator("en", { numeric: true });
      const ids = [...new Set(boxes.material.filter((_, box) => !boxes.fixed[box]))].sort(order.compare);
      const fill = (id: string) => MATERIALS[Math.max(0, ids.indexOf(id)) % MATERIALS.length];
      return {
        fills: boxes.material.map(fill),
        legend: ids.map((id) => ({ fill: fill(id), label: `material ${id}` })),
        moving: false,
      };
    }
    case "first": {
      const at = Array.from(boxes.firstBeyond);
      const known = at.filter((value) => !Number.isNaN(value));
      const first = Math.min(...known);
      const last = Math.max(...known, first + 1e-9);
      const within = { fill: calm(), label: "never beyond a limit" };
      // A scale has two ends: where all go at a time there is one colour.
      const one = seconds(first) === seconds(last) ? [{ fill: ramp(1), label: `first, ${seconds(first)}` }] : null;
      const scale = one ?? [{ from: `later, ${seconds(last)}`, to: `first, ${seconds(first)}` }];
      return {
        fills: at.map((value) => (Number.isNaN(value) ? calm() : ramp(1 - (0.85 * (value - first)) / (last - first)))),
        legend: known.length === 0 ? [within] : [...scale, within],
        moving: false,
      };
    }
    case "damage": {
      const { damage } = boxes;
      if (!damage || !results.damage) return paintVerdict(world);
      const indices = damageIndices(damage, results.damage.boundary);
      return paintScale(indices, 2, { from: "not struck", to: "twice the damage boundary, or more" }, false);
    }
    case "margin":
      return paintCritical(results, world);
    default:
      return paintVerdict(world);
  }
}

/** The box that is beyond a limit first above the margin, for each direction; a box that is so for several has one colour. */
function paintCritical(results: Results, world: World): Painted {
  const layout = results.worlds.layout[world.index];
  const margins = results.margins && judgedMargins(results.margins);
  const fills = Array.from<unknown, string>(world.boxes.id, calm);
  const directions = new Map<number, string[]>();
  const without: string[] = [];
  for (const [i, direction] of DIRECTIONS.entries()) {
    const critical = margins?.criticalBox[4 * layout + i] ?? 0;
    const text = `${direction} ${margin(margins?.margin[4 * layout + i] ?? Number.NaN)}`;
    const box = world.boxes.id.indexOf(critical);
    if (box < 0) without.push(text);
    else directions.set(box, [...(directions.get(box) ?? []), text]);
  }
  const legend: LegendEntry[] = [...directions].map(([box, texts], i) => {
    fills[box] = MATERIALS[[1, 0, 2, 3][i]];
    return { fill: fills[box], label: `${boxText(world.boxes, box)}: ${texts.join(", ")}` };
  });
  const none = without.length > 0 ? `no box: ${without.join(", ")}` : "other boxes";
  return { fills, legend: [...legend, { fill: calm(), label: none }], moving: false };
}
