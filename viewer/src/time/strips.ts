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
  low: number;
  high: number;
  /** the value that is farthest from 0 */
  most: number;
}

function strip(name: string, unit: string, lines: Line[]): Strip {
  let low = 0;
  let high = 0;
  for (const { values } of lines)
    for (let i = 0; i < values.length; ++i) {
      low = Math.min(low, values[i]);
      high = Math.max(high, values[i]);
    }
  const most = high >= -low ? high : low;
  return { name, unit, lines, low, high: low === high ? low + 1 : high, most };
}

export function strips(world: World, begin: number, end: number): Strip[] {
  const steps = accelerationSteps(world, begin, end);
  const time = [...steps.map((step) => step.time), end];
  const axes = ["x", "y", "z"].map((label, axis) => ({
    label,
    colour: `axis-${label}`,
    time,
    values: [...steps.map((step) => step.value[axis]), steps.at(-1)?.value[axis] ?? 0],
    steps: true,
  }));
  const acting = axes.filter(({ values }) => values.some((value) => value !== 0));
  const list = [strip("acceleration", "m/s²", acting.length > 0 ? acting : axes.slice(0, 1))];
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
