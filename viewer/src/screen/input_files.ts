import { isSpreadsheet, type Sheet, sheetsOf, UnreadableSpreadsheet } from "./spreadsheet";

/** A text that has loads: a file of the user's, or a sheet of one. */
export interface InputFile {
  /** as messages and loads name it */
  name: string;
  bytes: Uint8Array;
  /** of a sheet: the spreadsheet that it is from, of which only sheets with loads count */
  book: string | null;
}

/** What cannot be opened, as one sentence for the user. */
export class UnreadableInput extends Error {}

/** As the program: a larger file is no input. */
const MOST_BYTES = 128 << 20;

/** Files that are read as loads; those of results are opened by `ResultsClient`. */
export const isResults = (file: File) => /\.(h5|hdf5)$/i.test(file.name);

export const ACCEPTED = ".csv,.tsv,.txt,.json,.jsonl,.xlsx,.h5,.hdf5";

/** The texts of a file. */
export async function inputsOf(file: File): Promise<InputFile[]> {
  if (file.size > MOST_BYTES)
    throw new UnreadableInput(`${file.name} is too large for an input file: at most ${MOST_BYTES >> 20} MB.`);
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (!isSpreadsheet(bytes)) return [{ name: file.name, bytes, book: null }];
  let sheets: Sheet[];
  try {
    sheets = sheetsOf(file.name, bytes);
  } catch (error) {
    if (error instanceof UnreadableSpreadsheet) throw new UnreadableInput(error.message);
    throw error;
  }
  const encoder = new TextEncoder();
  return sheets.map(({ name, csv }) => ({
    name: sheets.length === 1 ? file.name : `${file.name} ${name}`,
    bytes: encoder.encode(csv),
    book: file.name,
  }));
}
