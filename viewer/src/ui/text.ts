import { NOT_COUNTED } from "../data/results";

/** Numbers as text, in the units that a planner uses. */

/** g: margins are not sought beyond it. */
export const LARGEST_MARGIN = 1.5;

/** A number with so many digits behind the point; what rounds to 0 has no sign. */
export function fixed(value: number, digits: number): string {
  const size = Math.abs(value).toFixed(digits);
  return `${value < 0 && Number(size) > 0 ? "−" : ""}${size}`;
}

/** A round number, beside an axis. */
export const tickText = (value: number) => String(Number(value.toPrecision(6))).replace("-", "−");

/** @param more digits beyond the usual ones */
export function metres(value: number, more = 0): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size < 0.0005 && more === 0) return "0";
  if (size < 0.01) return `${fixed(value * 1000, 1 + more)} mm`;
  if (size < 1) return `${fixed(value * 100, 1 + more)} cm`;
  return `${fixed(value, 2 + more)} m`;
}

/** Words for the two directions of each axis of the container: below 0 and above. */
const WAYS = [
  ["forwards", "backwards"],
  ["left", "right"],
  ["down", "up"],
] as const;

/** The parts of a displacement (m) in the words of whoever looks forwards, without those of less than a millimetre. */
export const waysOf = (displacement: ArrayLike<number>): [way: string, size: string][] =>
  WAYS.map((words, axis) => ({ size: Math.abs(displacement[axis]), word: words[displacement[axis] > 0 ? 1 : 0] }))
    .filter(({ size }) => size >= 0.001)
    .map(({ size, word }) => [word, metres(size)]);

export const degrees = (value: number, more = 0) => (Number.isFinite(value) ? `${fixed(value, 1 + more)}°` : "–");
export const seconds = (value: number) => (Number.isFinite(value) ? `${fixed(value, 2)} s` : "–");
export const kilograms = (value: number) => `${value < 10 ? value.toFixed(2) : value.toFixed(1)} kg`;
export const gravities = (value: number, more = 0) => (Number.isFinite(value) ? `${fixed(value, 2 + more)} g` : "–");

/**
 * A margin without its unit, rounded down: the load stands what the text says. It is negative where the load does not even stand
 * under gravity.
 */
export function marginNumber(value: number): string {
  if (!Number.isFinite(value)) return "–";
  if (value < 0) return "unstable";
  // Times 100, a number of two digits may lie a little below a whole one.
  const hundredths = Math.floor(100 * value + 1e-6);
  return value < LARGEST_MARGIN ? fixed(hundredths / 100, 2) : `${fixed(LARGEST_MARGIN, 2)}+`;
}
export const margin = (value: number) => (value >= 0 ? `${marginNumber(value)} g` : marginNumber(value));

/** Two numbers that a sentence compares, with as many digits as it takes to see which one is larger. */
export function compared(
  a: number,
  b: number,
  text: (value: number, more: number) => string,
): readonly [string, string] {
  const most = 6;
  let more = 0;
  while (more < most && a !== b && text(a, more) === text(b, more)) ++more;
  return [text(a, more), text(b, more)];
}

/** A share of a whole or of a limit. What is more than 100 % reads as more. */
export const percent = (share: number) =>
  Number.isFinite(share) ? compared(100 * share, 100, (value, more) => `${fixed(value, more)} %`)[0] : "–";

export const count = (value: number) => (value === NOT_COUNTED ? "–" : value.toLocaleString("en"));

export function joules(value: number): string {
  if (!Number.isFinite(value)) return "–";
  return value < 1000 ? `${value.toPrecision(value < 1 ? 2 : 3)} J` : `${(value / 1000).toPrecision(3)} kJ`;
}

export function newtons(value: number): string {
  if (!Number.isFinite(value)) return "–";
  return Math.abs(value) < 1000 ? `${fixed(value, 0)} N` : `${fixed(value / 1000, 1)} kN`;
}

export function bytes(value: number): string {
  if (value < 1e6) return `${(value / 1e3).toFixed(0)} kB`;
  return value < 1e9 ? `${(value / 1e6).toFixed(1)} MB` : `${(value / 1e9).toFixed(2)} GB`;
}

export const plural = (number: number, noun: string) =>
  `${number.toLocaleString("en")} ${noun}${number === 1 ? "" : noun.endsWith("x") ? "es" : "s"}`;
