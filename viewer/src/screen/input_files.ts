import { isSpreadsheet, type Sheet, sheetsOf, UnreadableSpreadsheet } from "./spreadsheet";

/** A text that has loads: a file of the user's, or a sheet of one. */
export interface InputFile {
  /** as messages and loads name it */
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
  /** of a sheet: the spreadsheet that it is from, of which only sheets with loads count */
  book: string | null;
  /** why it cannot be opened, as a sentence; absent: it can */
  problem?: string;
}

/** As the program: a larger file is no input. */
const MOST_BYTES = 128 << 20;

/** Files that are read as loads; those of results are opened by `ResultsClient`. */
export const isResults = (file: File) => /\.(h5|hdf5)$/i.test(file.name);

export const ACCEPTED = ".csv,.tsv,.txt,.json,.jsonl,.xlsx,.h5,.hdf5";

/** The texts of a file; where it cannot be opened, one that says why. */
export async function inputsOf(file: File): Promise<InputFile[]> {
  const refused = (problem: string) => [{ name: file.name, bytes: new Uint8Array(), book: null, problem }];
  if (file.size > MOST_BYTES)
    return refused(`${file.name} is too large for an input file: at most ${MOST_BYTES >> 20} MB.`);
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (!isSpreadsheet(file.name, bytes)) return [{ name: file.name, bytes, book: null }];
    return ofSheets(file.name, sheetsOf(file.name, bytes));
  } catch (error) {
    if (error instanceof UnreadableSpreadsheet) return refused(error.message);
    // A folder is no file, and a file may be gone.
    return refused(`${file.name} cannot be read: ${(error as Error).message}`);
  }
}

function ofSheets(book: string, sheets: readonly Sheet[]): InputFile[] {
  const encoder = new TextEncoder();
  return sheets.map(({ name, csv }) => ({
    name: sheets.length === 1 ? book : `${book} ${name}`,
    bytes: encoder.encode(csv),
    book,
  }));
}
