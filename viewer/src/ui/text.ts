import { NOT_COUNTED } from "../data/results";

/** Numbers as text, in the units that a planner uses. */

/** g: margins are not sought beyond it. */
const LARGEST_MARGIN = 1.5;

export function metres(value: number): string {
  if (!Number.isFinite(value)) return "–";
  if (value < 0) return value > -0.0005 ? "0" : `−${metres(-value)}`;
  const size = value;
  if (size < 0.0005) return "0";
  if (size < 0.01) return `${(value * 1000).toFixed(1)} mm`;
  if (size < 1) return `${(value * 100).toFixed(1)} cm`;
  return `${value.toFixed(2)} m`;
}

export const degrees = (value: number) => (Number.isFinite(value) ? `${value.toFixed(1)}°` : "–");
export function seconds(value: number): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value).toFixed(2);
  return `${value < 0 && Number(size) > 0 ? "−" : ""}${size} s`;
}
export const kilograms = (value: number) => `${value < 10 ? value.toFixed(2) : value.toFixed(1)} kg`;
export const gravities = (value: number) => (Number.isFinite(value) ? `${value.toFixed(2)} g` : "–");
export const margin = (value: number) =>
  value < LARGEST_MARGIN ? gravities(value) : gravities(value).replace(" ", "+ ");
export const count = (value: number) => (value === NOT_COUNTED ? "–" : value.toLocaleString("en"));

export function joules(value: number): string {
  if (!Number.isFinite(value)) return "–";
  return value < 1000 ? `${value.toPrecision(value < 1 ? 2 : 3)} J` : `${(value / 1000).toPrecision(3)} kJ`;
}

export function newtons(value: number): string {
  if (!Number.isFinite(value)) return "–";
  return Math.abs(value) < 1000 ? `${value.toFixed(0)} N` : `${(value / 1000).toFixed(1)} kN`;
}

export function bytes(value: number): string {
  if (value < 1e6) return `${(value / 1e3).toFixed(0)} kB`;
  return value < 1e9 ? `${(value / 1e6).toFixed(1)} MB` : `${(value / 1e9).toFixed(2)} GB`;
}

export const plural = (number: number, noun: string) =>
  `${number.toLocaleString("en")} ${noun}${number === 1 ? "" : noun.endsWith("x") ? "es" : "s"}`;
