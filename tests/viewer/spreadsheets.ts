import { strToU8, zipSync } from "fflate";

/** Spreadsheets that the tests drop on the page, and the same as CSV. */

export type Cell = string | number | { formula: string; value?: number };

/** 20 pallets in a trailer, two by two from the front wall, as a planner lists them. The last two stand alone, with gaps. */
export function palletRows(): Cell[][] {
  const rows: Cell[][] = [
    ["Item", "X cm", "Y cm", "Z cm", "Length cm", "Width cm", "Height cm", "Weight kg", "Material"],
  ];
  const kinds = ["Drinks", "Paper", "Textiles", "Parts", "Tinned food"];
  for (let i = 0; i < 20; ++i) {
    const pair = Math.floor(i / 2);
    const apart = i >= 18 ? 60 : 0;
    rows.push([
      `${kinds[pair % 5]} ${i + 1}`,
      80 * pair + apart,
      i % 2 === 0 ? 0 : 122,
      0,
      80,
      120,
      100 + 10 * (i % 4),
      400 + 15 * i,
      "pallet",
    ]);
  }
  return rows;
}

export const csvOf = (rows: readonly Cell[][]) =>
  `${rows.map((row) => row.map((cell) => (typeof cell === "object" ? (cell.value ?? "") : cell)).join(",")).join("\r\n")}\r\n`;

const escaped = (text: string) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");

function columnName(index: number): string {
  return index < 26 ? String.fromCharCode(65 + index) : columnName(Math.floor(index / 26) - 1) + columnName(index % 26);
}

/** Parts of a book whose sheets have such cells; texts are shared, as spreadsheet programs write them. */
export function partsOf(sheets: Readonly<Record<string, readonly Cell[][]>>): Record<string, string> {
  const texts: string[] = [];
  const head = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n';
  const main = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"';
  const names = Object.keys(sheets);
  const parts: Record<string, string> = {};
  for (const [index, rows] of Object.values(sheets).entries()) {
    const cellXml = (cell: Cell, at: string) => {
      if (typeof cell === "number") return `<c r="${at}"><v>${cell}</v></c>`;
      if (typeof cell === "object")
        return `<c r="${at}"><f>${escaped(cell.formula)}</f>${cell.value === undefined ? "" : `<v>${cell.value}</v>`}</c>`;
      if (cell === "") return "";
      if (!texts.includes(cell)) texts.push(cell);
      return `<c r="${at}" t="s"><v>${texts.indexOf(cell)}</v></c>`;
    };
    const rowsXml = rows.map((row, r) => {
      const cells = row.map((cell, c) => cellXml(cell, `${columnName(c)}${r + 1}`)).join("");
      return cells === "" ? "" : `<row r="${r + 1}">${cells}</row>`;
    });
    parts[`xl/worksheets/sheet${index + 1}.xml`] =
      `${head}<worksheet ${main}><sheetData>${rowsXml.join("")}</sheetData></worksheet>`;
  }
  const relations = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
  parts["xl/sharedStrings.xml"] =
    `${head}<sst ${main}>${texts.map((text) => `<si><t xml:space="preserve">${escaped(text)}</t></si>`).join("")}</sst>`;
  parts["xl/workbook.xml"] = `${head}<workbook ${main} xmlns:r="${relations}"><sheets>${names
    .map((name, i) => `<sheet name="${escaped(name)}" sheetId="${i + 1}" r:id="rId${i + 1}"/>`)
    .join("")}</sheets></workbook>`;
  parts["xl/_rels/workbook.xml.rels"] =
    `${head}<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">${names
      .map(
        (_, i) =>
          `<Relationship Id="rId${i + 1}" Type="${relations}/worksheet" Target="worksheets/sheet${i + 1}.xml"/>`,
      )
      .join("")}</Relationships>`;
  return parts;
}

/** With a time of its own, so that the bytes are the same in every run. */
export const zipped = (parts: Readonly<Record<string, string>>): Uint8Array =>
  zipSync(Object.fromEntries(Object.entries(parts).map(([name, text]) => [name, strToU8(text)])), {
    mtime: "2026-01-02",
  });

export const xlsxOf = (sheets: Readonly<Record<string, readonly Cell[][]>>): Uint8Array => zipped(partsOf(sheets));
