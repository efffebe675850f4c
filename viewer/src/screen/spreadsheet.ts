import { strFromU8, unzipSync } from "fflate";

/** Sheets of a spreadsheet file (.xlsx), each as the CSV that a user would have saved. */

/** What a file cannot be read for, as one sentence for the user. */
export class UnreadableSpreadsheet extends Error {}

/** Bytes that the parts of a file which are read may take, unpacked: some hundred thousand cells. */
const MOST_BYTES = 48 << 20;
/** The largest sheet that the format has. */
const MOST_ROWS = 1 << 20;
const MOST_COLUMNS = 1 << 14;
/** Rows that may be empty before a row of a sheet, in all: what names a row far below has no more of them. */
const MOST_EMPTY_ROWS = 10_000;

export interface Sheet {
  name: string;
  /** cells between semicolons, texts in quotes, one line per row of the sheet, so that lines count as rows do */
  csv: string;
}

/** Whether a file is named as a spreadsheet, or begins as one does: it is a ZIP archive. */
export const isSpreadsheet = (name: string, bytes: Uint8Array) =>
  /\.xlsx$/i.test(name) || (bytes[0] === 0x50 && bytes[1] === 0x4b && bytes[2] === 3);

/** The sheets of a file that have cells, in the order of the book. */
export function sheetsOf(name: string, bytes: Uint8Array): Sheet[] {
  const parts = unpacked(name, bytes);
  const book = parse(name, parts, "xl/workbook.xml");
  const places = new Map<string, string>();
  for (const relation of elements(parse(name, parts, "xl/_rels/workbook.xml.rels"), "Relationship"))
    places.set(relation.getAttribute("Id") ?? "", placeOf(relation.getAttribute("Target") ?? ""));
  const texts = parts["xl/sharedStrings.xml"] ? sharedTexts(parse(name, parts, "xl/sharedStrings.xml")) : [];
  const sheets: Sheet[] = [];
  for (const sheet of elements(book, "sheet")) {
    const id = [...sheet.attributes].find((attribute) => attribute.localName === "id" && attribute.prefix !== null);
    const place = places.get(id?.value ?? "") ?? "";
    // Sheets of charts alone are no tables.
    if (!/worksheets\//.test(place) || !parts[place]) continue;
    const csv = csvOf(name, parse(name, parts, place), texts);
    if (csv.trim() !== "") sheets.push({ name: sheet.getAttribute("name") ?? "", csv });
  }
  if (sheets.length === 0) throw new UnreadableSpreadsheet(`${name} has no sheet with cells.`);
  return sheets;
}

const NEEDED = /^xl\/(workbook\.xml|_rels\/workbook\.xml\.rels|sharedStrings\.xml|worksheets\/[^/]+\.xml)$/;

function unpacked(name: string, bytes: Uint8Array): Record<string, Uint8Array> {
  let size = 0;
  let parts: Record<string, Uint8Array>;
  try {
    parts = unzipSync(bytes, {
      // What a part says of its size is all the memory that it gets.
      filter: (part) => {
        if (!NEEDED.test(part.name)) return false;
        size += part.originalSize;
        if (size > MOST_BYTES)
          throw new UnreadableSpreadsheet(
            `${name} is too large: unpacked it has more than ${MOST_BYTES >> 20} MB. Save the sheet with the loads as CSV.`,
          );
        return true;
      },
    });
  } catch (error) {
    if (error instanceof UnreadableSpreadsheet) throw error;
    throw new UnreadableSpreadsheet(`${name} is damaged, or no spreadsheet of the kind .xlsx.`);
  }
  if (!parts["xl/workbook.xml"] || !parts["xl/_rels/workbook.xml.rels"])
    throw new UnreadableSpreadsheet(`${name} is no spreadsheet of the kind .xlsx. Save it as .xlsx or as CSV.`);
  return parts;
}

/** The place in the archive of what the book names: from the folder of the book, or from the root. */
const placeOf = (target: string) => (target.startsWith("/") ? target.slice(1) : `xl/${target}`);

function parse(name: string, parts: Record<string, Uint8Array>, part: string): Document {
  const text = strFromU8(parts[part]);
  // The format has no document types: what they declare could grow without end.
  const document = /<!DOCTYPE/i.test(text) ? null : new DOMParser().parseFromString(text, "application/xml");
  if (!document || document.getElementsByTagName("parsererror").length > 0)
    throw new UnreadableSpreadsheet(`${name} is damaged: its part ${part} cannot be read.`);
  return document;
}

const elements = (of: Document | Element, name: string) => [...of.getElementsByTagNameNS("*", name)];

/** The text of a cell or of a shared text, without what tells how it is read aloud. */
function textOf(of: Element): string {
  return elements(of, "t")
    .filter((part) => (part.parentNode as Element).localName !== "rPh")
    .map((part) => part.textContent ?? "")
    .join("");
}

const sharedTexts = (document: Document) => elements(document, "si").map(textOf);

/** Column of a reference such as `AB12`, from 0; -1: it has none. */
function columnOf(reference: string): number {
  let column = 0;
  for (const letter of /^[A-Z]{1,3}/.exec(reference)?.[0] ?? "") column = 26 * column + letter.charCodeAt(0) - 64;
  return column - 1;
}

/** In quotes, and in one line: lines count as rows do. */
const quoted = (text: string) => (text === "" ? "" : `"${text.replaceAll(/[\r\n]+/g, " ").replaceAll('"', '""')}"`);

function csvOf(name: string, sheet: Document, texts: readonly string[]): string {
  const lines: string[] = [];
  for (const row of elements(sheet, "row")) {
    const given = Number(row.getAttribute("r") ?? lines.length + 1);
    const number = Number.isInteger(given) ? given : 0;
    if (number <= lines.length || number > MOST_ROWS || number - lines.length > MOST_EMPTY_ROWS)
      throw new UnreadableSpreadsheet(`${name} is damaged: its rows are not in order.`);
    while (lines.length < number - 1) lines.push("");
    const cells: string[] = [];
    for (const cell of row.children) {
      if (cell.localName !== "c") continue;
      const at = columnOf(cell.getAttribute("r") ?? "");
      const column = at < 0 ? cells.length : at;
      if (column < cells.length || column >= MOST_COLUMNS)
        throw new UnreadableSpreadsheet(`${name} is damaged: the cells of row ${number} are not in order.`);
      while (cells.length < column) cells.push("");
      cells.push(cellText(name, cell, texts));
    }
    lines.push(cells.join(";"));
  }
  return `${lines.join("\n")}\n`;
}

/** A cell as CSV has it. Of a formula it is the value that was saved with it: nothing is computed here. */
function cellText(name: string, cell: Element, texts: readonly string[]): string {
  const value = [...cell.children].find((part) => part.localName === "v")?.textContent ?? "";
  switch (cell.getAttribute("t")) {
    case "s":
      return quoted(texts[Number(value)] ?? "");
    case "inlineStr":
      return quoted(textOf(cell));
    case "str":
    case "e":
      return quoted(value);
    case "b":
      return value === "1" ? "yes" : "no";
    default: {
      const formula = [...cell.children].some((part) => part.localName === "f");
      if (value === "" && formula)
        throw new UnreadableSpreadsheet(
          `${name}: the formula in ${cell.getAttribute("r")} was saved without its value. Open the file in a spreadsheet program, and save it again.`,
        );
      return /^[-+.\dEe]*$/.test(value) ? value : quoted(value);
    }
  }
}
