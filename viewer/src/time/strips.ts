import { UPRIGHT } from "../data/openings";
import { GRAVITY, pushesOf } from "../data/push";
import type { World } from "../data/results";
import { accelerationSteps } from "./acceleration";

/** A curve of the time panel. Values hold until the next point where `steps` says so. */
export interface Line {
  colour: string;
  label: string;
  time: ArrayLike<number>;
  values: ArrayLike<number>;
  steps: boolean;
}

export interface Strip {
  name: string;
  unit: string;
  lines: Line[];
  /** Round numbers beside the curve, in the unit: the axis ends with the first and the last one. */
  ticks: number[];
  /** what values are divided by, to be in the unit */
  per: number;
}

/** Numbers whose multiples by powers of 10 are round. */
const ROUND = [1, 2, 3, 4, 5];
/** Ticks lie as many steps apart at most: more have no room in a strip. */
const MOST_STEPS = 2;

/** The least round step, at least as large as a number. */
export function roundStep(least: number, mantissas: readonly number[] = ROUND): number {
  const power = 10 ** Math.floor(Math.log10(least));
  const found = mantissas.find((mantissa) => mantissa * power >= least * (1 - 1e-9));
  return found ? found * power : 10 * power;
}

/** Round numbers, equally far apart, that a range and 0 lie between. An axis from 0 to 1 where all is 0. */
export function roundTicks(low: number, high: number, whole = false): number[] {
  const [begin, end] = low < 0 || high > 0 ? [Math.min(0, low), Math.max(0, high)] : [0, 1];
  let step = roundStep((end - begin) / MOST_STEPS);
  if (whole) step = Math.max(1, step);
  const bounds = () => [Math.floor(begin / step + 1e-9), Math.ceil(end / step - 1e-9)];
  // With 0 among them, it may take a larger step.
  while (bounds()[1] - bounds()[0] > MOST_STEPS) step = roundStep(1.01 * step);
  const [first, last] = bounds();
  // Sums of steps would not be round.
  return Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

function strip(name: string, unit: string, lines: Line[]): Strip {
  let low = 0;
  let high = 0;
  for (const { values } of lines)
    for (let i = 0; i < values.length; ++i) {
      if (!Number.isFinite(values[i])) continue;
      low = Math.min(low, values[i]);
      high = Math.max(high, values[i]);
    }
  const per = unit === "J" && high >= 1000 ? 1000 : 1;
  const whole = unit === "boxes";
  return { name, unit: per > 1 ? `k${unit}` : unit, lines, ticks: roundTicks(low / per, high / per, whole), per };
}

export function strips(world: World, begin: number, end: number): Strip[] {
  const steps = accelerationSteps(world, begin, end);
  const time = [...steps.map((step) => step.time), end];
  const curve = (label: string, axis: string, of: (value: readonly number[]) => number): Line => {
    const values = steps.map(({ value }) => of(value));
    return { label, colour: `axis-${axis}`, time, values: [...values, values.at(-1) ?? 0], steps: true };
  };
  const pushes = [
    ...UPRIGHT.map(({ name, axis }, side) => curve(name, "xy"[axis], (value) => pushesOf(value)[side])),
    curve("down", "z", ([, , up]) => Math.max(0, up) / GRAVITY),
    curve("up", "z", ([, , up]) => Math.max(0, -up) / GRAVITY),
  ];
  const acting = pushes.filter(({ values }) => Array.from(values).some((value) => value !== 0));
  const list = [strip("pushed to", "g", acting.length > 0 ? acting : pushes.slice(0, 1))];
  const { series } = world;
  if (series) {
    const line = { label: "", time: series.time };
    list.push(
      strip("kinetic energy", "J", [{ ...line, colour: "soft", values: series.energy, steps: false }]),
      strip("fallen now", "boxes", [{ ...line, colour: "verdict-2", values: series.fallen, steps: true }]),
    );
  }
  return list;
}

/** Times at which boxes are beyond a limit first, and which ones. */
export function markers(firstBeyond: Float32Array): { time: number; boxes: number[] }[] {
  const byTime = new Map<number, number[]>();
  for (const [box, time] of firstBeyond.entries())
    if (!Number.isNaN(time)) byTime.set(time, [...(byTime.get(time) ?? []), box]);
  return [...byTime.entries()].sort(([a], [b]) => a - b).map(([time, boxes]) => ({ time, boxes }));
}
