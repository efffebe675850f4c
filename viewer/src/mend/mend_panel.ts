import type { Load, WorldOutcome } from "holdfast-engine";
import { boxText } from "../box/box_text";
import { UPRIGHT } from "../data/openings";
import { VERDICT_CODES } from "../data/outcome";
import { PENDING, type World } from "../data/results";
import { failing, VERDICTS } from "../data/verdict";
import { DIRECTIONS, goneBoxes } from "../fleet/rows";
import type { Screening } from "../screen/screening";
import { download, element } from "../ui/dom";
import type { Store } from "../ui/state";
import { margin } from "../ui/text";
import { against, MAT, moved, turned, withMats, without } from "./load_edits";
import { fileOf } from "./load_file";
import { pressedSide, type Remedy, remediesOf } from "./remedies";

/** m that a press of a button moves a box. */
const STEPS = [0.01, 0.1] as const;

/** What a remedy was found to do. */
interface Tried {
  remedy: Remedy;
  /** how many worlds do not hold with it */
  fails: number;
  sentence: string;
  /** g, in the direction of the world, once it is known */
  margin: number;
}

/** Changes a load, and tells at once what becomes of it. */
export class MendPanel {
  readonly node = element("section", { class: "mend", "aria-label": "Mend" });
  private readonly answers = element("div", { "aria-live": "polite" });
  private readonly box = element("div");
  private readonly undo: HTMLButtonElement;
  private readonly said = element("p", { class: "problem", role: "alert" });
  private readonly help = element("div", { "aria-live": "polite" });
  private readonly layout: number;
  private busy = false;
  private step: (typeof STEPS)[number] = STEPS[1];
  private readonly quit: () => void;

  /**
   * @param world that is looked at
   * @param changed shows it anew
   */
  constructor(
    private readonly screening: Screening,
    private readonly world: World,
    private readonly store: Store,
    private readonly changed: () => void,
  ) {
    this.layout = screening.results.worlds.layout[world.index];
    this.undo = element("button", { onclick: () => this.run(() => screening.undo(world.index)) }, "Undo");
    this.node.append(
      element("h2", {}, "Mend"),
      this.answers,
      this.box,
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
    );
    this.quit = store.listen((_, changes) => {
      if (changes.has("box")) this.showBox();
    });
    this.show();
  }

  close(): void {
    this.quit();
  }

  /** Shows what is known now. */
  show(): void {
    const edits = this.screening.edits(this.layout);
    this.undo.disabled = edits === 0 || this.busy;
    this.undo.textContent = edits > 1 ? `Undo (${edits})` : "Undo";
    this.answers.replaceChildren(this.table());
    this.showBox();
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
    const { box } = this.store.state;
    const { load } = this;
    if (box === null || box >= load.boxes.length) {
      this.box.replaceChildren(element("p", { class: "faint" }, "Choose a box to move, turn or take it away."));
      return;
    }
    const of = load.boxes[box];
    const edit = (next: Load) => this.edit(next);
    const size = this.world.container.size;
    const button = (text: string, title: string, next: () => Load) =>
      element("button", { title, disabled: this.busy, onclick: () => edit(next()) }, text);
    const centimetres = `${100 * this.step} cm`;
    const moves = UPRIGHT.map(({ name, axis, far }) =>
      button(name, `${centimetres} to the ${name}`, () => moved(this.load, box, axis, far ? this.step : -this.step)),
    );
    const stops = UPRIGHT.map((side) =>
      button(`→| ${side.name}`, `To the ${side.name}, until it touches`, () => against(this.load, box, side, size)),
    );
    this.box.replaceChildren(
      element("p", { class: "strong" }, boxText(this.world.boxes, box, "Box")),
      element(
        "div",
        { class: "buttons" },
        element(
          "button",
          {
            title: "How far a press moves it",
            onclick: () => {
              this.step = STEPS[(STEPS.indexOf(this.step) + 1) % STEPS.length];
              this.showBox();
            },
          },
          `by ${centimetres}`,
        ),
        ...moves,
        button("up", `${centimetres} up`, () => moved(this.load, box, 2, this.step)),
        button("down", `${centimetres} down`, () => moved(this.load, box, 2, -this.step)),
      ),
      element("div", { class: "buttons" }, ...stops),
      element(
        "div",
        { class: "buttons" },
        button("Turn", "Exchanges length and width", () => turned(this.load, box)),
        of.mat === undefined
          ? button("Mat beneath it", `An anti-slip mat, friction ${MAT}`, () => withMats(this.load, [box], MAT))
          : button("Without its mat", "Takes the mat away", () => withMats(this.load, [box], undefined)),
        button("Take away", "Leaves the box out", () => without(this.load, box)),
      ),
    );
  }

  private edit(next: Load): Promise<void> {
    return this.run(() => this.screening.mend(this.world.index, next));
  }

  private async run(work: () => Promise<void>): Promise<void> {
    if (this.busy) return;
    this.busy = true;
    this.said.textContent = "";
    this.show();
    try {
      await work();
      this.changed();
    } catch (error) {
      this.said.textContent = (error as Error).message.replaceAll(/the load: (\/\S+: )?/g, "");
    } finally {
      this.busy = false;
      this.show();
    }
  }

  private save(): void {
    const name = this.world.layout.replace(/\.\w+$/, "").replaceAll(/[^\w.-]+/g, "-");
    download(`${name}-mended.json`, new Blob([fileOf(this.load)], { type: "application/json" }));
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
            element("button", { onclick: () => this.edit(one.remedy.load) }, "Take"),
          ),
        ),
      ),
      ...(left > 0 ? [element("p", { class: "faint" }, `Trying ${left} more…`)] : []),
      ...(left === 0 && tried.length === 0 ? [element("p", {}, "Nothing of what was tried can be done here.")] : []),
    );
  }
}
