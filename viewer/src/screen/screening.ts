import type { Columns, Load, RunFacts, RunSettings, WorldOutcome } from "holdfast-engine";
import { loadText } from "../data/load_text";
import { NOT_COUNTED, PENDING, type Results, type World } from "../data/results";
import type { ResultsSource } from "../data/results_source";
import { Cancelled, type EnginePool } from "../engine/engine_pool";
import { askMargins } from "../engine/margins";
import type { FoundMargins, HashedLoad, SimulatedWorld } from "../engine/messages";
import { type KeptWorld, keptOf, type Screened } from "../save/screened";
import { badWorld, newResults, putMargins, putWorld, worldOf } from "./screened_results";

/** Worlds that are kept in memory after they were looked at. */
const KEPT = 8;

/** How far a screening is. */
export interface Progress {
  worldsDone: number;
  worlds: number;
  marginsDone: number;
  margins: number;
  /** since it began, until it ended */
  seconds: number;
  running: boolean;
  /** what went wrong with the engine itself, as a sentence; empty: nothing */
  problem: string;
}

/** Loads under all accelerations of a norm, simulated in this page: results that grow. */
export class Screening implements ResultsSource {
  readonly results: Results;
  private readonly listeners = new Set<() => void>();
  private readonly opened = new Map<number, Promise<World>>();
  private readonly usable: readonly number[];
  private readonly loads: HashedLoad[];
  /** by world; null: it is not simulated */
  private readonly kept: (KeptWorld | null)[];
  /** by layout; null: they are not found */
  private readonly foundMargins: (FoundMargins | null)[];
  /** of a load that is mended: what it was before each edit */
  private readonly history = new Map<number, Load[]>();
  private readonly began = performance.now();
  private ended: number | null = null;
  private worldsDone = 0;
  private marginsDone = 0;
  private problem = "";

  /**
   * @param name what the page calls the results
   * @param facts of the engine, with the same settings
   */
  constructor(
    private readonly pool: EnginePool,
    name: string,
    version: string,
    facts: RunFacts,
    loads: readonly HashedLoad[],
    private readonly settings: RunSettings,
    private readonly withMargins: boolean,
  ) {
    this.loads = loads.slice();
    this.results = newResults(name, version, facts, loads, withMargins);
    this.kept = Array<null>(this.results.worlds.layout.length).fill(null);
    this.foundMargins = Array<null>(loads.length).fill(null);
    this.usable = [...loads.keys()].filter((layout) => loads[layout].errors.length === 0);
  }

  /** Simulates all worlds, and then finds all margins. */
  async run(): Promise<void> {
    const { worlds } = this.results;
    const pending = [...worlds.verdict.keys()].filter((world) => worlds.verdict[world] === PENDING);
    const worldTasks = pending.map((world) => this.simulate(world));
    const marginTasks = this.withMargins ? this.usable.map((layout) => this.findMargins(layout)) : [];
    await Promise.all([...worldTasks, ...marginTasks]);
    this.ended = performance.now();
    this.tell();
  }

  /** Leaves out what is not simulated yet. */
  cancel(): void {
    this.pool.cancelWaiting();
  }

  get progress(): Progress {
    return {
      worldsDone: this.worldsDone,
      worlds: this.usable.length * this.results.accelerations.length,
      marginsDone: this.marginsDone,
      margins: this.withMargins ? this.usable.length : 0,
      seconds: ((this.ended ?? performance.now()) - this.began) / 1000,
      running: this.ended === null,
      problem: this.problem,
    };
  }

  /** Calls back whenever there is more of the results. */
  listen(listener: () => void): void {
    this.listeners.add(listener);
  }

  world(index: number): Promise<World> {
    const known = this.opened.get(index) ?? this.open(index);
    this.opened.delete(index);
    this.opened.set(index, known);
    if (this.opened.size > KEPT) this.opened.delete(this.opened.keys().next().value as number);
    return known;
  }

  criticalNames(): Promise<string[]> {
    const { layout, criticalBox } = this.results.worlds;
    const nameOf = (world: number) => {
      const box = criticalBox[world];
      if (box === 0 || box === NOT_COUNTED) return "";
      return this.loads[layout[world]].load.boxes[box - 1]?.name ?? "";
    };
    return Promise.resolve([...layout.keys()].map(nameOf));
  }

  /** The load of a layout as it is now; null: it cannot be used. */
  loadOf(layout: number): Load | null {
    const { load, errors } = this.loads[layout];
    return errors.length > 0 ? null : load;
  }

  /** All that is known by now, to be saved. A load that was mended is known by what it is now. */
  async screened(): Promise<Screened> {
    const { results, kept: worlds, foundMargins: margins } = this;
    const loads = await Promise.all(
      this.loads.map((load, layout) => (this.edits(layout) > 0 ? this.hashed(load) : load)),
    );
    return { results, loads, worlds, margins };
  }

  /** A load as one of a file that it is saved in. */
  private async hashed(read: HashedLoad): Promise<HashedLoad> {
    const bytes = new TextEncoder().encode(loadText(read.load));
    const found = await this.pool.ask("read", { name: read.name, bytes, choices: this.settings }, true);
    return { ...read, sha256: found.loads[0].sha256 };
  }

  /** How many edits of a load can be undone. */
  edits(layout: number): number {
    return this.history.get(layout)?.length ?? 0;
  }

  /**
   * Puts a load in the place of one, and answers for it anew, the world that is looked at first.
   * Where boxes cannot be so, it throws what the engine says, and nothing changes.
   */
  async mend(world: number, load: Load): Promise<void> {
    const layout = this.results.worlds.layout[world];
    const before = this.loads[layout].load;
    await this.replace(world, load);
    this.history.set(layout, [...(this.history.get(layout) ?? []), before]);
    this.tell();
  }

  /** Takes the latest edit of a load back. */
  async undo(world: number): Promise<void> {
    const layout = this.results.worlds.layout[world];
    const history = this.history.get(layout) ?? [];
    const before = history[history.length - 1];
    if (!before) return;
    await this.replace(world, before);
    this.history.set(layout, history.slice(0, -1));
    this.tell();
  }

  /** What would become of a load: its worlds, one per acceleration, and its margins. */
  tryOut(load: Load): { worlds: Promise<WorldOutcome[]>; margins: Promise<Columns> } {
    const { settings } = this;
    const worlds = this.results.accelerations.map((_, acceleration) =>
      this.pool.ask("world", { load, acceleration, settings }, true).then(({ outcome }) => outcome),
    );
    const margins = askMargins(this.pool, load, settings, true).then(({ columns }) => columns);
    return { worlds: Promise.all(worlds), margins };
  }

  private async replace(world: number, load: Load): Promise<void> {
    const { results, settings, pool } = this;
    const { worlds } = results;
    const layout = worlds.layout[world];
    const read = { ...this.loads[layout], load, boxCount: load.boxes.length };
    const all = [...worlds.layout.keys()].filter((of) => worlds.layout[of] === layout);
    const ask = (of: number) => pool.ask("world", { load, acceleration: worlds.acceleration[of], settings }, true);
    // All at once, the margins early since they take longest. What is not that of boxes that can be so comes to nothing.
    const looked = ask(world);
    const margins = this.withMargins ? [askMargins(pool, load, settings, true)] : [];
    const others = all.filter((one) => one !== world).map((of) => ({ of, asked: ask(of) }));
    Promise.allSettled([...margins, ...others.map(({ asked }) => asked)]);
    const found = await looked;
    this.loads[layout] = read;
    results.layoutBoxes[layout] = load.boxes.length;
    for (const of of all) {
      this.opened.delete(of);
      worlds.verdict[of] = PENDING;
      this.kept[of] = null;
    }
    this.foundMargins[layout] = null;
    results.margins?.inPlace.margin.fill(Number.NaN, 4 * layout, 4 * layout + 4);
    results.margins?.withinLimits?.margin.fill(Number.NaN, 4 * layout, 4 * layout + 4);
    this.put(world, found);
    this.opened.set(world, Promise.resolve(worldOf(results, world, read, found.outcome, found.columns)));
    const isLatest = () => this.loads[layout] === read;
    for (const { of, asked } of others)
      this.take(asked, (other) => {
        if (isLatest()) this.put(of, other);
      });
    for (const asked of margins)
      this.take(asked, (found) => {
        if (isLatest()) this.putMargins(layout, found);
      });
  }

  /** The same world again, with what its boxes did: it has the same bits. */
  private async open(index: number): Promise<World> {
    const { worlds } = this.results;
    const read = this.loads[worlds.layout[index]];
    if (read.errors.length > 0) return badWorld(this.results, index, read);
    const found = await this.pool.ask("world", this.order(index), true);
    if (worlds.verdict[index] === PENDING) this.put(index, found);
    return worldOf(this.results, index, read, found.outcome, found.columns);
  }

  private put(world: number, found: SimulatedWorld): void {
    putWorld(this.results, world, found.outcome, found.seconds);
    this.kept[world] = keptOf(found);
  }

  private putMargins(layout: number, found: FoundMargins): void {
    putMargins(this.results, layout, found.columns);
    this.foundMargins[layout] = found;
  }

  private order(world: number) {
    const { layout, acceleration } = this.results.worlds;
    const { load } = this.loads[layout[world]];
    return { load, acceleration: acceleration[world], settings: this.settings };
  }

  private simulate(world: number): Promise<void> {
    const layout = this.results.worlds.layout[world];
    const read = this.loads[layout];
    return this.take(this.pool.ask("world", this.order(world)), (found) => {
      ++this.worldsDone;
      // It may have been mended meanwhile.
      if (this.loads[layout] === read) this.put(world, found);
    });
  }

  private findMargins(layout: number): Promise<void> {
    const read = this.loads[layout];
    return this.take(askMargins(this.pool, read.load, this.settings), (found) => {
      ++this.marginsDone;
      if (this.loads[layout] === read) this.putMargins(layout, found);
    });
  }

  private async take<Answer>(asked: Promise<Answer>, put: (answer: Answer) => void): Promise<void> {
    try {
      put(await asked);
    } catch (error) {
      if (!(error instanceof Cancelled)) this.problem = (error as Error).message;
    }
    this.tell();
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
