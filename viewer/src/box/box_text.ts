import type { BoxColumns } from "../data/results";

/** A box as the page calls it: its number, and its name where it has another one. */
export function boxText({ name, id }: Pick<BoxColumns, "id" | "name">, box: number, word = "box"): string {
  const number = String(id[box] ?? box + 1);
  const own = name[box] ?? "";
  return own === "" || own === number ? `${word} ${number}` : `${word} ${number}, ${own}`;
}
