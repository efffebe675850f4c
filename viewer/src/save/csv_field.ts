import type { Container } from "../data/results";
import { namesOf } from "../data/status";

/** Fields of tables, as the program writes them. */

/** A text as a field; what a spreadsheet would take for a formula begins with an apostrophe. */
export function csvText(text: string): string {
  const formula = /^[=+\-@\t\r]/.test(text);
  return formula || /[",\r\n]/.test(text) ? `"${formula ? "'" : ""}${text.replaceAll('"', '""')}"` : text;
}

/** Powers of ten from and below which the program's tables have numbers without an exponent. */
const PLAIN_FROM = -4;
const PLAIN_BELOW = 16;

/**
 * The shortest text that is the same number again, as the program's tables have it; empty where it is not known.
 * @param single it has single precision
 */
export function csvNumber(value: number, single: boolean): string {
  if (Number.isNaN(value)) return "";
  if (Object.is(value, -0)) return "-0";
  const number = single ? shortest(value) : value;
  const [mantissa, exponent] = number.toExponential().split("e");
  const power = Number(exponent);
  if (power >= PLAIN_FROM && power < PLAIN_BELOW) return String(number);
  return `${mantissa}e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
}

/** The number with the fewest digits that is the same one in single precision. */
function shortest(value: number): number {
  for (let digits = 1; digits < 9; ++digits) {
    const rounded = Number(value.toPrecision(digits));
    if (Math.fround(rounded) === value) return rounded;
  }
  return Number(value.toPrecision(9));
}

/** Type or size of a load's own container; nothing where it is that of the run. */
export const csvContainer = (own: Container | undefined) =>
  csvText(own?.type || (own ? `${own.size.map((length) => csvNumber(length, false)).join(" x ")} m` : ""));

/** Names of bits that are set. */
export const csvBits = (bits: Readonly<Record<string, number>>, set: number) => namesOf(bits, set).join("+");
