import type { Catalogue, RunFacts } from "holdfast-engine";
import type { EnginePool } from "../engine/engine_pool";
import type { HashedFile, HashedLoad } from "../engine/messages";
import { askedLine, columnsOption, LOOKED_AT, type Puzzle, puzzleOf, RememberedColumns } from "./column_choices";
import type { InputFile } from "./input_files";
import {
  type FileChoices,
  fromText,
  type RunChoices,
  readChoices,
  runSettings,
  toText,
  whyNotUsed,
} from "./run_choices";

/** Milliseconds without a change before files are read anew: while somebody types, they are not. */
const PATIENCE = 150;

/** A file as it was read, or why it could not be. */
export interface Reading extends Pick<InputFile, "name" | "book"> {
  found: HashedFile | null;
  error: string;
  /** of a table whose words do not tell everything: what its columns are said to mean; null: they tell, or it is none */
  puzzle: Puzzle | null;
  /** what is said of this file alone */
  own: FileChoices;
}

/** What is to be screened, and with what: files, choices, and what the engine makes of both. */
export class Setup {
  readonly catalogue: Catalogue;
  readonly version: string;
  choices: RunChoices;
  readings: Reading[] = [];
  /** null: the choices cannot be used, and `problem` says why */
  facts: RunFacts | null = null;
  problem = "";
  /** files are read, or about to be */
  busy = false;
  private files: InputFile[] = [];
  private readonly columns = new RememberedColumns();
  /** what is said of single files, by name */
  private readonly ofFiles = new Map<string, FileChoices>();
  private turn = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly listeners = new Set<() => void>();

  private constructor(
    readonly pool: EnginePool,
    catalogue: Catalogue,
    version: string,
    choices: string,
    private readonly keep: (choices: string) => void,
  ) {
    this.catalogue = catalogue;
    this.version = version;
    this.choices = fromText(choices);
  }

  /**
   * @param choices as `keep` has got them
   * @param keep keeps choices, as a text
   */
  static async start(pool: EnginePool, choices: string, keep: (choices: string) => void): Promise<Setup> {
    const [catalogue, version] = await Promise.all([pool.ask("catalogue", {}), pool.ask("version", {})]);
    return new Setup(pool, catalogue, version, choices, keep);
  }

  listen(listener: () => void): void {
    this.listeners.add(listener);
  }

  /** A file takes the place of one with the same name. */
  add(files: readonly InputFile[]): Promise<void> {
    const names = new Set(files.map((file) => file.book ?? file.name));
    this.files = [...this.files.filter((file) => !names.has(file.book ?? file.name)), ...files];
    return this.read();
  }

  /** Says something of a file alone; nothing takes all of it back. */
  changeFile(name: string, change: FileChoices | null): Promise<void> {
    if (change) this.ofFiles.set(name, { ...this.ofFiles.get(name), ...change });
    else this.ofFiles.delete(name);
    return this.read();
  }

  remove(name: string): Promise<void> {
    this.ofFiles.delete(name);
    this.files = this.files.filter((file) => file.name !== name);
    return this.read();
  }

  change(change: Partial<RunChoices>): void {
    this.choices = { ...this.choices, ...change };
    this.keep(toText(this.choices));
    this.busy = true;
    this.tell();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.read(), PATIENCE);
  }

  /** All loads, those that cannot be used among them. */
  get loads(): HashedLoad[] {
    return this.readings.flatMap(({ found }) => found?.loads ?? []);
  }

  get usable(): number {
    return this.loads.filter((load) => load.errors.length === 0).length;
  }

  /** What results are called: by their only file, or by how many there are. */
  get name(): string {
    const names = [...new Set(this.files.map((file) => file.book ?? file.name))];
    return names.length === 1 ? names[0] : `${names.length} files`;
  }

  /** Reads all files with the choices of now. */
  private async read(): Promise<void> {
    const turn = ++this.turn;
    this.busy = true;
    this.tell();
    const { choices, files, pool } = this;
    let facts: RunFacts | null = null;
    let problem = "";
    let readings: Reading[] = this.readings;
    try {
      const why = whyNotUsed(choices);
      if (why) throw new Error(why);
      facts = await pool.ask("run", { settings: runSettings(choices) }, true);
      readings = await Promise.all(files.map((file) => this.readFile(file, choices)));
    } catch (error) {
      problem = (error as Error).message;
    }
    if (turn !== this.turn) return;
    this.facts = facts;
    this.problem = problem;
    this.readings = ofBooks(readings);
    this.busy = false;
    this.tell();
  }

  private async readFile(file: InputFile, choices: RunChoices): Promise<Reading> {
    const { name, bytes, book } = file;
    const own = this.ofFiles.get(name) ?? {};
    const reading: Reading = { name, book, found: null, error: file.problem ?? "", puzzle: null, own };
    if (file.problem) return reading;
    // What is said of all files comes first.
    const container = choices.container || own.container || "";
    const read = async (columns: string) => {
      const asked = { ...readChoices({ ...choices, ...own, container }), columns };
      const found = await this.pool.ask("read", { name, bytes, choices: asked }, true);
      const shape = choices.container
        ? undefined
        : this.catalogue.containers.find((of) => of.name === container)?.shape;
      if (shape) for (const { load } of found.loads) load.container = shape;
      return found;
    };
    try {
      const found = await read("");
      const line = askedLine(found);
      if (line === null) return { ...reading, found };
      const rows = await this.pool.ask("preview", { bytes, rows: LOOKED_AT }, true);
      const puzzle = puzzleOf(rows, line, (header) => this.columns.of(header));
      const option = puzzle ? columnsOption(puzzle.header, puzzle.words) : "";
      if (!puzzle || option === "") return { ...reading, found, puzzle };
      const explained = await read(option);
      return { ...reading, found: explained, puzzle: { ...puzzle, solved: askedLine(explained) === null } };
    } catch (error) {
      return { ...reading, error: (error as Error).message };
    }
  }

  /** Says what the columns of tables with such a header mean. */
  explain(header: readonly string[], words: readonly string[]): Promise<void> {
    this.columns.set(header, words);
    return this.read();
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}

/** Of a book the sheets that have boxes; where none has, the first one, which says what it lacks. */
function ofBooks(readings: readonly Reading[]): Reading[] {
  const hasBoxes = ({ found }: Reading) => found?.loads.some((load) => load.boxCount > 0) ?? false;
  const full = new Set(readings.filter(hasBoxes).map(({ book }) => book));
  const first = new Map<string, Reading>();
  for (const reading of readings)
    if (reading.book !== null && !first.has(reading.book)) first.set(reading.book, reading);
  return readings.filter(
    (reading) =>
      reading.book === null || (full.has(reading.book) ? hasBoxes(reading) : first.get(reading.book) === reading),
  );
}
