import { boxText } from "../box/box_text";
import { containerFactsOf } from "../box/container_facts";
import { frictionText } from "../data/friction";
import { CAVEAT_BITS } from "../data/outcome";
import { pushSentence } from "../data/push";
import { NOT_COUNTED, type Results } from "../data/results";
import { causes, caveatsOf } from "../data/status";
import { isAtLeast, JUDGED_AT_END, meaningOf, NOT_MODELLED, VERDICTS, verdictText } from "../data/verdict";
import { choice, download, element } from "../ui/dom";
import { legendItems } from "../ui/legend";
import type { Store } from "../ui/state";
import { count, degrees, margin, metres, newtons, percent, plural, seconds } from "../ui/text";
import { onTheme } from "../ui/theme";
import { fleetCsv } from "./csv";
import { type CellAt, Matrix } from "./matrix";
import { arranged, DIRECTIONS, ORDERS, type Row, rowsOf, type Scale, type Sort, verdictCounts } from "./rows";
import { isOfMargins, scaleLegend, scalesOf } from "./scales";

/** The container of the run, or that layouts have their own. */
function containerFacts({ container, ownContainers, layouts }: Results): [string, string][] {
  const own = ownContainers.size;
  if (own > 0 && own === layouts.length) return [["container", "each layout has its own"]];
  const facts = containerFactsOf(container);
  if (own > 0) facts.push(["other containers", `${own} of ${plural(layouts.length, "layout")} have their own`]);
  return facts;
}

/** Worlds of a file of which names are read without being asked for. */
const MOST_NAMED = 2000;

/** The landing page of a file: which loadings fail under what. */
export class FleetView {
  readonly node: HTMLElement;
  private all: Row[];
  private rows: Row[] = [];
  private described: CellAt | null = null;
  private readonly matrix: Matrix;
  private readonly detail = element("section", { class: "detail", "aria-live": "polite" });
  private readonly shown = element("span", { class: "faint" });
  private readonly order = element("span", { class: "faint" });
  private readonly colours = element("ul", { class: "colours" });
  private readonly filter: HTMLInputElement;
  /** of critical boxes, by world */
  private names: string[] = [];
  private namesAsked = false;
  /** verdicts and caveats with how many worlds have them */
  private readonly counts = element("div", { class: "counts" });

  /** @param head what stands above the matrix; null: nothing */
  constructor(
    private readonly results: Results,
    private readonly store: Store,
    private readonly criticalNames: () => Promise<string[]>,
    head: HTMLElement | null = null,
  ) {
    this.all = rowsOf(results);
    this.matrix = new Matrix(
      results,
      (at) => this.describe(at),
      (at) => this.open(at),
    );
    const { state } = store;
    this.filter = element("input", {
      type: "search",
      placeholder: "Filter layouts",
      "aria-label": "Filter layouts by words of their names",
      value: state.filter,
      oninput: () => store.update({ filter: this.filter.value }),
    });
    const sorts: { value: Sort; label: string }[] = [
      { value: "worst", label: "worst first" },
      { value: "name", label: "name" },
    ];
    if (results.margins) sorts.splice(1, 0, { value: "margin", label: "smallest margin" });
    const sorting = choice<Sort>("Sort", sorts, state.sort, (sort) => store.update({ sort }));
    const colouring = choice<Scale>("Colour", scalesOf(results), state.scale, (scale) => store.update({ scale }));
    this.node = element(
      "main",
      { class: "fleet" },
      element(
        "div",
        { class: "work" },
        head,
        element(
          "div",
          { class: "tools" },
          this.filter,
          sorting.node,
          colouring.node,
          this.shown,
          element("span", { class: "gap" }),
          element("button", { onclick: () => this.save(), title: "One line per world, as a table" }, "CSV"),
        ),
        element("div", { class: "order" }, this.order, this.colours),
        this.matrix.node,
      ),
      element("aside", {}, this.counts, this.detail, this.facts()),
    );
    store.listen((next, changed) => {
      sorting.set(next.sort);
      colouring.set(next.scale);
      if (changed.has("sort") || changed.has("scale") || changed.has("filter")) this.arrange();
      if (changed.has("filter") && this.filter.value !== store.state.filter) this.filter.value = store.state.filter;
    });
    onTheme(() => this.showColours());
    this.arrange();
    this.count();
    this.describe(null);
  }

  /** Layouts in the order shown, without those that are filtered out. */
  get shownLayouts(): number[] {
    return this.rows.map(({ layout }) => layout);
  }

  /**
   * Shows results that have grown.
   * @param keepsOrder rows stay where they are, so that they can be pointed at while more comes
   */
  grow(keepsOrder: boolean): void {
    this.all = rowsOf(this.results);
    if (keepsOrder) {
      const places = this.rows.map(({ layout }) => layout);
      this.rows = places.map((layout) => this.all[layout]);
      this.matrix.show(this.rows, this.store.state.scale);
    } else this.arrange();
    this.count();
    this.describe(this.described);
  }

  private count(): void {
    this.counts.replaceChildren(...[this.legend(), this.caveats()].filter((part) => part !== null));
  }

  focus(): void {
    this.matrix.focus();
  }

  /** The next world, in the order shown, that does not hold; -1 goes back. */
  nextFailing(from: number | null, step: 1 | -1, fails: (verdict: number) => boolean): number | null {
    const order = this.rows.flatMap((row) => [...row.worlds].filter((world) => world >= 0));
    const start = from === null ? (step > 0 ? -1 : order.length) : order.indexOf(from);
    for (let i = start + step; i >= 0 && i < order.length; i += step)
      if (fails(this.results.worlds.verdict[order[i]])) return order[i];
    return null;
  }

  private arrange(): void {
    const { filter, sort, scale } = this.store.state;
    this.node.dataset.scale = scale;
    this.rows = arranged(this.all, this.results.layouts, filter, sort);
    const all = this.all.length;
    this.shown.textContent =
      this.rows.length === all ? plural(all, "layout") : `${count(this.rows.length)} of ${plural(all, "layout")}`;
    this.order.textContent = ORDERS[sort];
    this.showColours();
    this.matrix.show(this.rows, scale);
  }

  private showColours(): void {
    this.colours.replaceChildren(...legendItems(scaleLegend(this.store.state.scale, this.results)));
  }

  private worldAt(at: CellAt): number {
    const row = this.rows[at.row];
    if (!isOfMargins(this.store.state.scale)) return row.worlds[at.column];
    // A margin belongs to the layout: its worst world is shown.
    const badness = (world: number) => (world < 0 ? -1 : VERDICTS[this.results.worlds.verdict[world]].badness);
    return [...row.worlds].reduce((worst, world) => (badness(world) > badness(worst) ? world : worst), -1);
  }

  private open(at: CellAt): void {
    const world = this.worldAt(at);
    if (world >= 0) this.store.update({ world, other: null, box: null, time: 0 });
  }

  private legend(): HTMLElement {
    const counts = verdictCounts(this.results);
    return element(
      "section",
      { class: "verdicts" },
      element("h2", {}, "Verdicts"),
      this.results.judgedAtEnd ? element("p", { class: "notable" }, JUDGED_AT_END) : null,
      element(
        "ul",
        { class: "legend" },
        ...VERDICTS.map((verdict, code) =>
          counts[code] === 0
            ? null
            : element(
                "li",
                { title: meaningOf(code, this.results.judgedAtEnd) },
                element("i", { class: `swatch verdict-${code}` }, verdict.glyph),
                element("span", {}, verdict.name),
                element("b", {}, count(counts[code])),
              ),
        ),
      ),
    );
  }

  /** Worlds of which there is something to know beside their verdicts. */
  private caveats(): HTMLElement | null {
    const items = Object.values(CAVEAT_BITS).flatMap((bit) => {
      const worlds = this.results.worlds.caveats.reduce((sum, caveats) => sum + ((caveats & bit) !== 0 ? 1 : 0), 0);
      const [{ name, meaning }] = caveatsOf(bit);
      return worlds === 0
        ? []
        : [element("li", { title: meaning }, element("span", {}, name), element("b", {}, count(worlds)))];
    });
    if (items.length === 0) return null;
    return element("section", {}, element("h2", {}, "Caveats"), element("ul", { class: "legend" }, ...items));
  }

  /** What the world under the pointer is about. */
  private describe(at: CellAt | null): void {
    this.described = at;
    const world = at ? this.worldAt(at) : -1;
    if (!at || world < 0) {
      this.detail.replaceChildren(
        element("h2", {}, "World"),
        element("p", { class: "faint" }, "Point at a cell to see its numbers, click it to open the world."),
      );
      return;
    }
    this.readNames();
    const { worlds, layouts, accelerations, segments, margins, replicas, judgedAtEnd } = this.results;
    const layout = this.rows[at.row].layout;
    const verdict = worlds.verdict[world];
    const least = isAtLeast(verdict, worlds.stopReason[world]) ? "at least " : "";
    const boxes = (number: number) => (number > 0 ? least : "") + count(number);
    const facts: [string, string][] = [
      ["boxes", count(worlds.boxes[world])],
      ["fell", boxes(worlds.fallen[world])],
      ["moved", boxes(worlds.moved[world])],
      ["tilted", boxes(worlds.tilted[world])],
      ["unstable", boxes(worlds.unstable[world])],
      ["fallen at the end", count(worlds.fallenAtEnd[world])],
      [VERDICTS[verdict].fails ? "goes first" : "nearest to a limit", this.criticalText(world)],
      ["largest displacement", metres(worlds.peakDisplacement[world])],
      ["displacement at the end", metres(worlds.endDisplacement[world])],
      ["largest drop", metres(worlds.peakDrop[world])],
      ["largest tilt", degrees(worlds.peakTilt[world])],
      ["ends at", seconds(worlds.endTime[world])],
    ];
    const own = this.results.ownContainers.get(layout);
    if (own) facts.push(...containerFactsOf(own));
    if (replicas && replicas.count[world] > 0)
      facts.push(["replicas that fail", `${replicas.failed[world]} of ${replicas.count[world]}`]);
    const { damage, hardestWalls } = this.results;
    if (damage) facts.push(["beyond the damage boundary", count(damage.boxesBeyond[world])]);
    if (hardestWalls && Number.isFinite(hardestWalls.force[world])) {
      const { force, share, norm } = hardestWalls;
      const ofLimit = norm !== "" ? `, ${percent(share[world])} of ${norm}` : "";
      facts.push(["hardest on a wall", newtons(force[world]) + ofLimit]);
    }
    const marginsOf = (all: Float64Array) =>
      DIRECTIONS.map((name, i) => `${name} ${margin(all[4 * layout + i])}`).join(", ");
    if (margins) facts.push(["margins in place", marginsOf(margins.inPlace.margin)]);
    if (margins?.withinLimits) facts.push(["margins within the limits", marginsOf(margins.withinLimits.margin)]);
    this.detail.replaceChildren(
      element("h2", {}, "World"),
      element("p", { class: "strong" }, layouts[layout]),
      element("p", { class: "soft" }, accelerations[worlds.acceleration[world]]),
      element("p", { class: "soft" }, pushSentence(segments[worlds.acceleration[world]])),
      element(
        "p",
        {},
        element("i", { class: `swatch verdict-${verdict}` }, VERDICTS[verdict].glyph),
        element("span", { class: "strong" }, ` ${verdictText(verdict, worlds.stopReason[world])}`),
      ),
      element("p", { class: "soft" }, meaningOf(verdict, judgedAtEnd)),
      ...causes(worlds.status[world]).map((cause) => element("p", { class: "problem" }, cause.meaning)),
      ...caveatsOf(worlds.caveats[world]).map((caveat) => element("p", { class: "notable" }, caveat.meaning)),
      element("dl", {}, ...facts.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)])),
    );
  }

  /** The critical box of a world with its name, once names have been read. */
  private criticalText(world: number): string {
    const box = this.results.worlds.criticalBox[world];
    if (box === 0) return "none";
    return box === NOT_COUNTED ? "–" : boxText({ id: Uint32Array.of(box), name: [this.names[world] ?? ""] }, 0);
  }

  /** Reads names when a world is pointed at first, of a file that has few enough for that. */
  private async readNames(): Promise<void> {
    if (this.namesAsked || this.results.worlds.layout.length > MOST_NAMED) return;
    this.namesAsked = true;
    this.names = await this.criticalNames().catch(() => []);
    // What is shown may have been filtered meanwhile.
    if (this.described && this.described.row < this.rows.length) this.describe(this.described);
  }

  private facts(): HTMLElement {
    const { results } = this;
    const { settings, thresholds } = results;
    const facts: [string, string][] = [
      ["engine", `${results.engine} ${settings["Native/Accuracy"] ?? ""}`],
      ["friction", frictionText(settings)],
      ...containerFacts(results),
      ["limits", `drop ${metres(thresholds.drop)}, move ${metres(thresholds.move)}, tilt ${degrees(thresholds.tilt)}`],
      ["made", `${results.created.replace("T", " ").replace("Z", "")} by ${results.software}`],
    ];
    return element(
      "section",
      {},
      element("h2", {}, "Run"),
      element("dl", {}, ...facts.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)])),
      element("p", { class: "faint" }, NOT_MODELLED),
    );
  }

  private async save(): Promise<void> {
    const names = await this.criticalNames().catch(() => []);
    const name = this.results.name.replace(/\.\w+$/, "");
    download(`${name}.csv`, new Blob([fleetCsv(this.results, this.rows, names)], { type: "text/csv" }));
  }
}
