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
}

function strip(name: string, unit: string, lines: Line[]): Strip {
  let low = 0;
  let high = 0;
  for (const { values } of lines)
    for (let i = 0; i < values.length; ++i) {
      low = Math.min(low, values[i]);
      high = Math.max(high, values[i]);
    }
  return { name, unit, lines, low, high: low === high ? low + 1 : high };
}

export function strips(world: World, end: number): Strip[] {
  const steps = accelerationSteps(world, end);
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
      strip("fallen", "boxes", [{ ...line, colour: "verdict-2", values: series.fallen, steps: true }]),
    );
  }
  return list;
}

/** Times at which boxes move first, and which ones. */
export function markers(world: World, firstMove: Int32Array): { time: number; boxes: number[] }[] {
  const bySample = new Map<number, number[]>();
  for (const [box, sample] of firstMove.entries())
    if (sample >= 0) bySample.set(sample, [...(bySample.get(sample) ?? []), box]);
  return [...bySample.entries()]
    .sort(([a], [b]) => a - b)
    .map(([sample, boxes]) => ({ time: world.series?.time[sample] ?? 0, boxes }));
}
