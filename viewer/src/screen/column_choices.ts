import type { ReadFile, TableRow } from "holdfast-engine";

/** What columns of a table mean, where their words do not tell: chosen by the user, and remembered for tables with the same header. */

/** What a column may mean, as the option `--columns` of the program takes it. */
export const MEANINGS: readonly (readonly [word: string, label: string])[] = [
  ["", "as it is named"],
  ["-", "nothing"],
  ["x", "place along the length"],
  ["y", "place across"],
  ["z", "height above the floor"],
  ["length", "length"],
  ["width", "width"],
  ["height", "height"],
  ["x2", "far end along the length"],
  ["y2", "far end across"],
  ["z2", "top"],
  ["name", "name"],
  ["mass", "mass"],
  ["material", "material"],
  ["load", "load it belongs to"],
  ["container", "container type"],
  ["order", "when it is loaded"],
  ["mat", "friction of its mat"],
  ["bearing limit", "what may rest on it"],
];

/** Rows that are looked at: titles may stand above the header. */
export const LOOKED_AT = 30;
/** Rows below the header that are shown. */
const SHOWN = 4;

/** Columns of a table of boxes: places and sizes. */
const FEWEST = 6;

/** A table whose columns are not understood. */
export interface Puzzle {
  header: string[];
  rows: string[][];
  /** word for each column; empty: as it is named */
  words: string[];
  /** with these words the table is understood */
  solved: boolean;
}

/** The line of the header, where a reader asks what its columns mean; null: it does not. */
export function askedLine({ errors, loads }: ReadFile): number | null {
  const problems = [...errors, ...loads.flatMap((load) => load.errors)];
  return problems.find(({ accepted }) => accepted.includes("--columns"))?.line ?? null;
}

/**
 * The table below a line.
 * @param wordsOf what is remembered of a header
 */
export function puzzleOf(
  rows: readonly TableRow[],
  line: number,
  wordsOf: (header: readonly string[]) => readonly string[],
): Puzzle | null {
  const first = rows.findIndex((row) => row.line === line);
  if (first < 0) return null;
  // Where no row says anything, the first one is named, which may be a title.
  const below = rows.findIndex((row, i) => i >= first && row.cells.filter((cell) => cell !== "").length >= FEWEST);
  const at = below < 0 ? first : below;
  const header = rows[at].cells;
  const words = wordsOf(header);
  return {
    header,
    rows: rows.slice(at + 1, at + 1 + SHOWN).map(({ cells }) => header.map((_, column) => cells[column] ?? "")),
    words: header.map((_, column) => words[column] ?? ""),
    solved: false,
  };
}

/** Headers are compared without signs, and these two have a meaning of their own in the option. */
const plain = (header: string) => header.replaceAll(/[,=]/g, " ").trim();

/** The option of the program. */
export const columnsOption = (header: readonly string[], words: readonly string[]): string =>
  header
    .flatMap((name, column) => (words[column] && plain(name) !== "" ? [`${plain(name)} = ${words[column]}`] : []))
    .join(", ");

/** Choices that are kept in this browser, by header. */
export class RememberedColumns {
  private readonly known: Map<string, string[]>;

  constructor(private readonly storage: Pick<Storage, "getItem" | "setItem"> | null = storageOfPage()) {
    this.known = new Map(this.read());
  }

  of(header: readonly string[]): string[] {
    return this.known.get(JSON.stringify(header)) ?? [];
  }

  set(header: readonly string[], words: readonly string[]): void {
    if (words.some((word) => word !== "")) this.known.set(JSON.stringify(header), [...words]);
    else this.known.delete(JSON.stringify(header));
    try {
      this.storage?.setItem(KEY, JSON.stringify([...this.known]));
    } catch {
      // It is full, or not allowed: then it is remembered until the page is closed.
    }
  }

  private read(): [string, string[]][] {
    try {
      const kept: unknown = JSON.parse(this.storage?.getItem(KEY) ?? "[]");
      if (!Array.isArray(kept)) return [];
      return kept.filter(
        (entry): entry is [string, string[]] =>
          Array.isArray(entry) &&
          typeof entry[0] === "string" &&
          Array.isArray(entry[1]) &&
          entry[1].every((word) => MEANINGS.some(([known]) => known === word)),
      );
    } catch {
      return [];
    }
  }
}

const KEY = "holdfast columns";

function storageOfPage(): Storage | null {
  try {
    return localStorage;
  } catch {
    return null;
  }
}
