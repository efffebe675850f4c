import type { Load, LoadBox, WorldOutcome } from "holdfast-engine";
import { loadText } from "../data/load_text";
import { VERDICT_CODES } from "../data/outcome";
import { PENDING, type World } from "../data/results";
import { failing, VERDICTS } from "../data/verdict";
import { DIRECTIONS, goneBoxes } from "../fleet/rows";
import type { Screening } from "../screen/screening";
import { download, element } from "../ui/dom";
import type { Store } from "../ui/state";
import { margin } from "../ui/text";
import { BoxForm } from "./box_form";
import { BoxTools, placedFirst } from "./box_tools";
import { isSame } from "./load_edits";
import { pressedSide, type Remedy, remediesOf } from "./remedies";

/** Identifier of the list of materials that the load has. */
const MATERIALS = "materials";

/** What a remedy was found to do. */
interface Tried {
  remedy: Remedy;
  /** how many worlds do not hold with it */
  fails: number;
  sentence: string;
  /** g, in the direction of the world, once it is known */
  margin: number;
}

/** What something in the panel does, in words that stay the same while its text changes. */
function doingOf(node: HTMLElement): string {
  const form = node.closest("form")?.ariaLabel ?? "";
  return `${form} ${node.dataset.does ?? node.closest("label")?.textContent ?? node.textContent ?? ""}`;
}

/** Changes a load, and tells at once what becomes of it. */
export class MendPanel {
  readonly node = element("section", { class: "mend", "aria-label": "Mend", tabindex: -1 });
  private readonly answers = element("div", { "aria-live": "polite" });
  private readonly tools: BoxTools;
  private readonly undo: HTMLButtonElement;
  private readonly said = element("p", { class: "problem", role: "alert" });
  private readonly help = element("div", { "aria-live": "polite" });
  private readonly layout: number;
  private busy = false;
  private readonly quit: () => void;

  /**
   * @param world that is looked at
   * @param changed shows it anew
   */
  constructor(
    private readonly screening: Screening,
    private readonly world: World,
    private readonly store: Store,
    private readonly changed: () => Promise<void>,
  ) {
    this.layout = screening.results.worlds.layout[world.index];
    this.tools = new BoxTools(
      world,
      () => this.load,
      MATERIALS,
      (make, choose) => this.edit(make, choose),
    );
    this.undo = element("button", {
      "data-does": "undo",
      onclick: () => this.run(() => screening.undo(world.index)),
    });
    this.node.append(
      element("h2", {}, "Mend"),
      this.answers,
      this.tools.node,
      this.newBox(),
      this.said,
      element(
        "div",
        { class: "buttons" },
        this.undo,
        element(
          "button",
          { onclick: () => this.tryRemedies(), title: "Tries what may help, best first" },
          "What would help?",
        ),
        element(
          "button",
          { onclick: () => this.save(), title: "JSON, which the page and the program read" },
          "Save load",
        ),
      ),
      this.help,
      element(
        "datalist",
        { id: MATERIALS },
        ...[...new Set(this.load.boxes.map(({ material }) => String(material)))].map((value) =>
          element("option", { value }),
        ),
      ),
    );
    this.quit = store.listen((_, changes) => {
      if (!changes.has("box")) return;
      const { focused } = this;
      this.showBox();
      if (focused !== null) this.focus(focused);
    });
    this.show();
    this.showBox();
  }

  close(): void {
    this.quit();
  }

  /** What has the focus in this panel, by what it does; null: nothing. */
  get focused(): string | null {
    const at = document.activeElement as HTMLElement | null;
    return at && this.node.contains(at) ? doingOf(at) : null;
  }

  /** Gives it to what does the same, and to the panel where nothing does. */
  focus(does: string): void {
    const all = [...this.node.querySelectorAll<HTMLElement>("button:enabled, input, summary")];
    const found = all.find((one) => doingOf(one) === does) ?? this.node;
    found.closest("details")?.setAttribute("open", "");
    found.focus();
  }

  /** Shows what is known now. */
  show(): void {
    const edits = this.screening.edits(this.layout);
    this.undo.disabled = edits === 0;
    this.undo.textContent = edits > 1 ? `Undo (${edits})` : "Undo";
    this.answers.replaceChildren(this.table());
  }

  private get load(): Load {
    return this.screening.loadOf(this.layout)!;
  }

  /** A line per acceleration: its verdict, and the margin of its direction. */
  private table(): HTMLElement {
    const { results } = this.screening;
    const { worlds, margins, accelerations } = results;
    const rows = [...worlds.layout.keys()].filter((world) => worlds.layout[world] === this.layout);
    return element(
      "table",
      {},
      ...rows.map((world) => {
        const verdict = worlds.verdict[world];
        const known = verdict !== PENDING;
        const side = pressedSide({ segments: results.segments[worlds.acceleration[world]] });
        const stands =
          side === null ? Number.NaN : (margins?.withinLimits?.margin[4 * this.layout + side] ?? Number.NaN);
        const gone = known ? goneBoxes(results, world) : 0;
        return element(
          "tr",
          { class: world === this.world.index ? "strong" : undefined },
          element("td", {}, accelerations[worlds.acceleration[world]]),
          element(
            "td",
            {},
            known ? element("i", { class: `swatch verdict-${verdict}` }, VERDICTS[verdict].glyph) : null,
            known ? ` ${VERDICTS[verdict].name}${gone > 0 ? ` ${gone}` : ""}` : "…",
          ),
          element("td", { class: "value" }, margins ? (Number.isNaN(stands) ? "…" : margin(stands)) : ""),
        );
      }),
    );
  }

  private showBox(): void {
    this.tools.show(this.store.state.box);
  }

  /** Asks for a box that is not in the load yet. */
  private newBox(): HTMLElement {
    const size = this.world.container.size;
    const form = new BoxForm("A new box", {}, null, true, MATERIALS, {
      word: "Add",
      act: () =>
        this.edit((load) => {
          const corner_max = form.size() as LoadBox["corner_max"];
          return placedFirst(load, { corner_min: [0, 0, 0], corner_max, ...form.said() }, size);
        }, this.load.boxes.length),
    });
    return element("details", {}, element("summary", {}, "Add a box"), form.node);
  }

  /** @param choose a box of the new load, to go on with */
  private edit(make: (load: Load) => Load, choose?: number): Promise<void> {
    return this.run(async () => {
      const next = make(this.load);
      if (!isSame(next, this.load)) await this.screening.mend(this.world.index, next);
    }, choose);
  }

  private async run(work: () => Promise<void>, choose?: number): Promise<void> {
    if (this.busy) return;
    this.busy = true;
    this.node.setAttribute("aria-busy", "true");
    this.said.textContent = "";
    try {
      await work();
      const { box } = this.store.state;
      if (box !== null && box >= this.load.boxes.length) this.store.update({ box: null });
      await this.changed();
      if (choose !== undefined) this.store.update({ box: choose });
    } catch (error) {
      this.said.textContent = (error as Error).message.replaceAll(/the load: (\/\S+: )?/g, "");
    } finally {
      this.busy = false;
      this.node.removeAttribute("aria-busy");
      this.show();
    }
  }

  private save(): void {
    const name = this.world.layout.replace(/\.\w+$/, "").replaceAll(/[^\w.-]+/g, "-");
    download(`${name}-mended.json`, new Blob([loadText(this.load)], { type: "application/json" }));
  }

  /** Tries what may help; the best first. */
  private async tryRemedies(): Promise<void> {
    const { screening, world } = this;
    const remedies = remediesOf(this.load, world);
    const tried: Tried[] = [];
    const side = pressedSide(world);
    let left = remedies.length;
    const show = () => this.showTried(tried, left);
    show();
    await Promise.all(
      remedies.map(async (remedy) => {
        try {
          const { worlds, margins } = screening.tryOut(remedy.load);
          margins.catch(() => {});
          const outcomes = await worlds;
          const one: Tried = { remedy, ...this.judged(outcomes), margin: Number.NaN };
          tried.push(one);
          show();
          const found = await margins;
          if (side !== null) one.margin = found.margin_within_limits[side];
        } catch {
          // Boxes cannot be so: it is no remedy.
        } finally {
          --left;
          show();
        }
      }),
    );
  }

  private judged(outcomes: readonly WorldOutcome[]): { fails: number; sentence: string } {
    const bad = outcomes.flatMap(({ verdict }, acceleration) =>
      failing(VERDICT_CODES[verdict]) ? [this.screening.results.accelerations[acceleration]] : [],
    );
    const sentence = bad.length === 0 ? "holds under all accelerations" : `still fails under ${bad.join(", ")}`;
    return { fails: bad.length, sentence };
  }

  private showTried(tried: readonly Tried[], left: number): void {
    const side = pressedSide(this.world);
    const now =
      side === null
        ? Number.NaN
        : (this.screening.results.margins?.withinLimits?.margin[4 * this.layout + side] ?? Number.NaN);
    const known = (value: number) => (Number.isNaN(value) ? Number.NEGATIVE_INFINITY : value);
    const best = [...tried].sort((a, b) => a.fails - b.fails || known(b.margin) - known(a.margin));
    const gain = (value: number) =>
      Number.isNaN(value) || side === null ? "" : `; margin ${DIRECTIONS[side]} ${margin(now)} → ${margin(value)}`;
    this.help.replaceChildren(
      element(
        "ul",
        { class: "remedies" },
        ...best.map((one) =>
          element(
            "li",
            { class: one.fails === 0 ? "holds" : undefined },
            element(
              "span",
              {},
              element("span", { class: "strong" }, one.remedy.text),
              `: ${one.sentence}${gain(one.margin)}.`,
            ),
            element("button", { onclick: () => this.edit(() => one.remedy.load) }, "Take"),
          ),
        ),
      ),
      ...(left > 0 ? [element("p", { class: "faint" }, `Trying ${left} more…`)] : []),
      ...(left === 0 && tried.length === 0 ? [element("p", {}, "Nothing of what was tried can be done here.")] : []),
    );
  }
}
