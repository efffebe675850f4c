import type { Shown } from "./box/compare_table";
import type { Place } from "./data/messages";
import { fromBase64 } from "./data/packed";
import type { Results } from "./data/results";
import { ResultsClient } from "./data/results_client";
import type { ResultsSource } from "./data/results_source";
import { failing } from "./data/verdict";
import { EngineClient, engineCarried } from "./engine/engine_client";
import { EnginePool } from "./engine/engine_pool";
import { FleetView } from "./fleet/fleet_view";
import { LiveView } from "./live/live_view";
import { whyNotLive } from "./live/live_words";
import { VIEWS } from "./load/camera_rig";
import { firstOther, otherWorld, sameWorld } from "./load/other_world";
import { WorldView } from "./load/world_view";
import { MendPanel } from "./mend/mend_panel";
import { Printed } from "./print/printed";
import { ACCEPTED, inputsOf, isResults } from "./screen/input_files";
import { ProgressBar } from "./screen/progress_bar";
import { runSettings } from "./screen/run_choices";
import { Screening } from "./screen/screening";
import { Setup } from "./screen/setup";
import { SetupView } from "./screen/setup_view";
import { download, element } from "./ui/dom";
import { helpDialog } from "./ui/help";
import { type Keymap, listenToKeys } from "./ui/keys";
import { landing } from "./ui/landing";
import { START, Store, type ViewState } from "./ui/state";
import { startTheme } from "./ui/theme";
import { TopBar } from "./ui/top_bar";

/** No world is open. */
const FLEET = { world: null, other: null, live: false, mend: false } as const;

/** Milliseconds between two pictures of a matrix that fills. */
const FILLING = 200;

/** Said where loads are to be screened, and the page was built without the engine. */
const NO_ENGINE =
  "This page has no engine in it, and shows results files alone: make viewer-engine, and then make viewer, put it in.";

/**
 * Starts the page: loads come from the user, and a results file from the user, from the page itself or from the address that served
 * it.
 */
class App {
  private readonly root = document.getElementById("app")!;
  private readonly store = new Store(location.hash);
  private readonly chooser = element("input", {
    type: "file",
    multiple: true,
    accept: ACCEPTED,
    "aria-label": "Files",
  });
  private readonly secondChooser = element("input", {
    type: "file",
    accept: ".h5,.hdf5",
    "aria-label": "Second results file",
  });
  private readonly bar = new TopBar(
    () => this.goFleet(),
    () => this.chooser.click(),
    () => this.help.showModal(),
    () => this.print(),
  );
  private readonly printed = new Printed();
  private readonly help = helpDialog();
  private readonly client = ResultsClient.start();
  /** What is shown; null: nothing yet. */
  private source: ResultsSource | null = null;
  private second: ResultsSource | null = null;
  private setup: { setup: Promise<Setup>; pool: EnginePool } | null = null;
  private turn = 0;
  private setupView: SetupView | null = null;
  private screening: Screening | null = null;
  private fleet: FleetView | null = null;
  private world: WorldView | null = null;
  private live: LiveView | null = null;
  private mending: MendPanel | null = null;
  /** name of the layout whose world is shown */
  private shownLayout = "";
  /** why the world that is shown cannot run here */
  private whyNot: string | null = null;

  constructor() {
    this.chooser.hidden = true;
    this.chooser.addEventListener("change", () => {
      this.take([...(this.chooser.files ?? [])]);
      this.chooser.value = "";
    });
    this.secondChooser.hidden = true;
    this.secondChooser.addEventListener("change", () => {
      const file = this.secondChooser.files?.[0];
      if (file) this.openSecond(file);
      this.secondChooser.value = "";
    });
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      this.take([...(event.dataTransfer?.files ?? [])]);
    });
    document.body.append(this.printed.node);
    document.addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "p" || !this.results) return;
      event.preventDefault();
      this.print();
    });
    addEventListener("beforeprint", () => {
      if (this.results && this.fleet && this.printed.node.childElementCount === 0)
        this.printed.overview(this.results, this.fleet.shownLayouts);
    });
    addEventListener("afterprint", () => this.printed.clear());
    addEventListener("popstate", () => this.store.restore(location.hash));
    this.store.listen((_, changed) => {
      if (["world", "other", "live", "mend"].some((key) => changed.has(key as keyof ViewState))) this.show();
    });
    listenToKeys(() => ({ ...this.keys(), ...this.live?.keys }));
    this.begin();
  }

  /** Prints a page of the load that is open, or of each that the matrix shows. */
  private async print(): Promise<void> {
    const { source, fleet } = this;
    if (!source || !fleet) return;
    const { results } = source;
    const { world } = this.store.state;
    this.root.setAttribute("aria-busy", "true");
    try {
      const layouts = world === null ? fleet.shownLayouts : [results.worlds.layout[world]];
      await this.printed.print(results, layouts, (index) => source.world(index));
    } catch (error) {
      this.bar.say((error as Error).message);
    } finally {
      this.root.removeAttribute("aria-busy");
    }
  }

  private keys(): Keymap {
    const world = (action: (view: WorldView) => void) => () => {
      if (this.world) action(this.world);
    };
    const flip = (key: "ghost" | "traces" | "centre") =>
      either(() => this.store.update({ [key]: !this.store.state[key] }));
    const either = (action: (view: WorldView | LiveView) => void) => () => {
      const view = this.live ?? this.world;
      if (view) action(view);
    };
    const views = Object.fromEntries(VIEWS.map((_, index) => [`${index + 1}`, either((view) => view.view(index))]));
    return {
      " ": world((view) => view.clock.toggle()),
      ArrowRight: world((view) => view.timePanel.stepSample(1)),
      ArrowLeft: world((view) => view.timePanel.stepSample(-1)),
      "shift+ArrowRight": world((view) => view.timePanel.stepMarker(1)),
      "shift+ArrowLeft": world((view) => view.timePanel.stepMarker(-1)),
      Home: world((view) => view.clock.seek(view.clock.begin)),
      End: world((view) => view.clock.seek(view.clock.end)),
      ...views,
      f: either((view) => view.focus()),
      g: flip("ghost"),
      t: flip("traces"),
      c: flip("centre"),
      n: () => this.goFailing(1),
      p: () => this.goFailing(-1),
      m: () => this.goFleet(),
      x: () => this.compare(),
      e: world(() => this.mend()),
      l: world(() => this.drive()),
      s: either((view) => this.savePicture(view)),
      v: world((view) => this.saveVideo(view)),
      "?": () => this.help.showModal(),
      Escape: () => {
        if (this.store.state.box !== null) this.store.update({ box: null });
        else if (this.store.state.live) this.store.update({ live: false });
        else if (!this.help.open) this.goFleet();
      },
    };
  }

  private goFleet(): void {
    this.store.update(FLEET);
    if (this.setupShown) this.show();
  }

  /** Opens the next world, in the order of the matrix, that does not hold. */
  private goFailing(step: 1 | -1): void {
    const next = this.fleet?.nextFailing(this.store.state.world, step, failing);
    if (next !== null && next !== undefined) this.store.update({ ...FLEET, world: next, box: null, time: 0 });
  }

  private nameOfSaved(ending: string): string {
    const { results, store } = this;
    const world = store.state.world ?? 0;
    const layout = results?.layouts[results.worlds.layout[world]].replace(/\.\w+$/, "");
    return `${layout}-${results?.accelerations[results.worlds.acceleration[world]]}.${ending}`;
  }

  private async savePicture(view: WorldView | LiveView): Promise<void> {
    download(this.nameOfSaved("png"), await view.picture());
  }

  private async saveVideo(view: WorldView): Promise<void> {
    const video = await view.video();
    if (video) download(this.nameOfSaved("webm"), video);
  }

  private async begin(): Promise<void> {
    const embedded = document.getElementById("results");
    if (embedded?.dataset.address)
      await this.open(
        { kind: "address", name: embedded.dataset.name!, url: new URL(embedded.dataset.address, location.href).href },
        false,
      );
    else if (embedded)
      await this.open(
        { kind: "bytes", name: embedded.dataset.name!, bytes: await fromBase64(embedded.textContent!) },
        false,
      );
    else this.fill(landing(null, () => this.chooser.click()));
  }

  private get results(): Results | null {
    return this.source?.results ?? null;
  }

  /** Files of the user's: results, or loads. */
  private async take(files: readonly File[]): Promise<void> {
    if (files.length === 0) return;
    const file = files.find(isResults);
    if (file) return this.open({ kind: "file", file });
    if (!engineCarried()) return this.refuse(NO_ENGINE);
    this.root.setAttribute("aria-busy", "true");
    try {
      const inputs = (await Promise.all(files.map(inputsOf))).flat();
      const setup = await this.startSetup();
      await setup.add(inputs);
      this.showSetup(setup);
    } catch (error) {
      this.refuse((error as Error).message);
    } finally {
      this.root.removeAttribute("aria-busy");
    }
  }

  private async open(place: Place, afresh = true): Promise<void> {
    this.root.setAttribute("aria-busy", "true");
    try {
      const client = await this.client;
      await client.open(place);
      if (afresh) this.store.update({ ...START, colouring: this.store.state.colouring });
      await this.showSource(client, null);
    } catch (error) {
      this.source = null;
      this.refuse((error as Error).message);
    } finally {
      this.root.removeAttribute("aria-busy");
    }
  }

  /** Says what could not be opened: where something is shown, above it. */
  private refuse(sentence: string): void {
    if (this.source || this.setupShown) {
      this.bar.say(sentence);
      return;
    }
    this.bar.show(null, []);
    this.fill(landing(sentence, () => this.chooser.click()));
  }

  private async showSource(source: ResultsSource, head: HTMLElement | null): Promise<void> {
    this.source = source;
    this.fleet = new FleetView(source.results, this.store, () => source.criticalNames(), head);
    this.closeWorld();
    await this.show();
  }

  private startSetup(): Promise<Setup> {
    if (!this.setup) {
      const pool = new EnginePool();
      const setup = Setup.start(pool, this.store.state.run, (run) => this.store.update({ run }));
      this.setup = { setup, pool };
    }
    return this.setup.setup;
  }

  private get setupShown(): boolean {
    return this.root.querySelector("main.setup") !== null;
  }

  private showSetup(setup: Setup): void {
    this.setupView ??= new SetupView(
      setup,
      () => this.chooser.click(),
      () => this.screen(setup),
    );
    this.closeWorld();
    this.bar.show(this.results, ["Loads"]);
    this.fill(this.setupView.node);
    this.setupView.focus();
  }

  /** Simulates the loads of a setup, and shows their matrix, which fills. */
  private async screen(setup: Setup): Promise<void> {
    const { pool, facts, loads, choices, name, version } = setup;
    if (!facts) return;
    this.screening?.cancel();
    const screening = new Screening(pool, name, version, facts, loads, runSettings(choices), choices.margins);
    this.screening = screening;
    this.store.update({ ...START, colouring: this.store.state.colouring, run: this.store.state.run });
    const bar = new ProgressBar(screening, () => this.showSetup(setup));
    await this.showSource(screening, bar.node);
    const { fleet } = this;
    let latest = 0;
    screening.listen(() => {
      const { running } = screening.progress;
      const now = performance.now();
      if (running && now - latest < FILLING) return;
      latest = now;
      fleet?.grow(running);
      this.mending?.show();
      if (this.mending) this.world?.refresh();
    });
    await screening.run();
  }

  /** The fleet, a world, or two. */
  private async show(): Promise<void> {
    const { source, fleet } = this;
    if (!source || !fleet) return;
    const { results } = source;
    const { world, other, live } = this.store.state;
    const turn = ++this.turn;
    if (world === null || world >= results.worlds.layout.length) {
      this.closeWorld();
      this.bar.show(results, []);
      this.fill(fleet.node);
      fleet.focus();
      return;
    }
    this.root.setAttribute("aria-busy", "true");
    try {
      const shown = [{ results, world: await source.world(world) }];
      this.whyNot = whyNotLive(shown[0].world);
      if (live && !this.whyNot) {
        await this.showLive(shown[0], turn);
        return;
      }
      const second = this.secondFile();
      if (other !== null && second && other < second.results.worlds.layout.length)
        shown.push({ results: second.results, world: await second.world(other) });
      if (turn !== this.turn) return;
      const before = this.world && this.shownLayout === shown[0].world.layout ? this.world : null;
      const focused = this.mending?.focused ?? null;
      this.closeWorld();
      const mend = this.mendPanel(shown);
      const chooser = shown[1] ? this.chooserOf(shown[1]) : null;
      this.world = new WorldView(shown, this.store, chooser, this.actions(), mend?.node, before);
      this.mending = mend;
      this.shownLayout = shown[0].world.layout;
      this.bar.show(
        results,
        shown.map((of) => `${of.world.layout} · ${of.world.acceleration}`),
      );
      this.fill(this.world.node);
      if (focused !== null) mend?.focus(focused);
      if (live && this.whyNot) this.bar.say(this.whyNot);
    } catch (error) {
      this.store.update(FLEET);
      this.bar.say((error as Error).message);
    } finally {
      this.root.removeAttribute("aria-busy");
    }
  }

  /** The world in the engine of this page. */
  private async showLive({ results, world }: Shown, turn: number): Promise<void> {
    const client = await EngineClient.start();
    const version = await client.ask("version", {});
    if (turn !== this.turn) return client.close();
    this.closeWorld();
    this.store.update({ time: 0 });
    const live = new LiveView(results, world, client, version, this.store, this.actions());
    this.live = live;
    await live.begin();
    if (turn !== this.turn) return;
    this.bar.show(results, [`${world.layout} · ${world.acceleration}`, "live"]);
    this.fill(live.node);
  }

  /** What changes the load of a world; null: nobody wants to, or it is not of this page. */
  private mendPanel(shown: readonly Shown[]): MendPanel | null {
    const { screening, source, store } = this;
    if (!store.state.mend || !screening || source !== screening || shown.length > 1) return null;
    if (!screening.loadOf(screening.results.worlds.layout[shown[0].world.index])) return null;
    return new MendPanel(screening, shown[0].world, store, () => this.show());
  }

  /** What else can be done with a world. */
  private actions(): HTMLElement[] {
    const { other, mend } = this.store.state;
    const mending = element(
      "button",
      {
        title: "Move, turn, swap, add and take away boxes, and what would help (E)",
        "aria-pressed": String(mend),
        onclick: () => this.mend(),
      },
      "Mend",
    );
    return [
      ...(this.source === this.screening && this.screening ? [mending] : []),
      element(
        "button",
        {
          title: this.whyNot ?? "Drive it in the engine of this page (L)",
          "aria-pressed": String(this.store.state.live && !this.whyNot),
          "aria-disabled": this.whyNot ? "true" : undefined,
          onclick: () => this.drive(),
        },
        "Live",
      ),
      element(
        "button",
        {
          title: "Side by side with another world (X)",
          "aria-pressed": String(other !== null),
          onclick: () => this.compare(),
        },
        "Compare",
      ),
    ];
  }

  private mend(): void {
    if (this.screening && this.source === this.screening)
      this.store.update({ mend: !this.store.state.mend, other: null, otherFile: "" });
  }

  private drive(): void {
    const { world, live } = this.store.state;
    if (this.whyNot) this.bar.say(this.whyNot);
    else if (world !== null) this.store.update({ live: !live, other: null, otherFile: "" });
  }

  /** The file that the second world of a comparison is from. */
  private secondFile(): ResultsSource | null {
    const { otherFile } = this.store.state;
    if (otherFile === "") return this.source;
    return this.second?.results.name === otherFile ? this.second : null;
  }

  private compare(): void {
    const { world, other } = this.store.state;
    if (!this.results || world === null) return;
    this.store.update({ live: false, other: other === null ? firstOther(this.results, world) : null, otherFile: "" });
  }

  private chooserOf(shown: Shown): HTMLElement {
    return otherWorld(
      shown.results,
      shown.world.index,
      (other) => this.store.update({ other }),
      () => this.secondChooser.click(),
      () => this.store.update({ other: null, otherFile: "" }),
    );
  }

  /** Compares with the same layout and acceleration in another file: of another engine, for instance. */
  private async openSecond(file: File): Promise<void> {
    const { world } = this.store.state;
    if (!this.results || world === null) return;
    const { worlds, layouts, accelerations } = this.results;
    const layout = layouts[worlds.layout[world]];
    const acceleration = accelerations[worlds.acceleration[world]];
    try {
      const client = await ResultsClient.start();
      const results = await client.open({ kind: "file", file });
      const other = sameWorld(results, layout, acceleration);
      if (other < 0) throw new Error(`${file.name} has no world of ${layout} under ${acceleration}.`);
      this.second = client;
      this.store.update({ other: null, otherFile: "" });
      this.store.update({ other, otherFile: file.name });
    } catch (error) {
      this.bar.say((error as Error).message);
    }
  }

  private closeWorld(): void {
    this.world?.close();
    this.world = null;
    this.mending?.close();
    this.mending = null;
    this.live?.close();
    this.live = null;
  }

  private fill(view: HTMLElement): void {
    this.root.replaceChildren(this.bar.node, view, this.chooser, this.secondChooser, this.help);
  }
}

startTheme();
new App();
