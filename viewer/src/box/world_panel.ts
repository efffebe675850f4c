import { type Results, SIDES, type World } from "../data/results";
import { causes } from "../data/status";
import { VERDICTS } from "../data/verdict";
import { DIRECTIONS } from "../fleet/rows";
import type { Derived } from "../load/quantities";
import { tiltOf } from "../time/first_moves";
import { between, times } from "../time/poses";
import { element } from "../ui/dom";
import type { Store } from "../ui/state";
import { degrees, gravities, joules, kilograms, metres, newtons, plural, seconds } from "../ui/text";
import { BoxList } from "./box_list";
import { causeOf } from "./cause";

/** The numbers of a world: its verdict, who went first and why, a box, forces on the walls, all boxes. */
export class WorldPanel {
  readonly node: HTMLElement;
  readonly list: BoxList;
  private readonly box = element("section", { class: "box", "aria-live": "polite" });
  private readonly walls = element("section", { class: "walls" });
  private readonly top = element("div", { class: "top" });

  constructor(
    private readonly results: Results,
    private readonly world: World,
    private readonly derived: Derived,
    private readonly store: Store,
    private readonly focus: (box: number) => void,
    hover: (box: number | null) => void,
  ) {
    this.list = new BoxList(world, derived, (box) => store.update({ box }), hover);
    this.node = element("aside", { class: "panel" }, this.top, this.box, this.walls, this.list.node);
    this.refresh();
    this.showTime(store.state.time);
  }

  /** Shows numbers anew that have changed, as those of a live world do. */
  refresh(orderAnew = true): void {
    const first = this.first();
    this.top.replaceChildren(this.head(), ...(first ? [first] : []));
    this.list.refresh(orderAnew);
    this.showBox(this.store.state.box);
  }

  private head(): HTMLElement {
    const { world, results } = this;
    const verdict = VERDICTS[world.verdict];
    const { worlds, margins, replicas } = results;
    const index = world.index;
    const said: string[] = [];
    const add = (number: number, text: string) => {
      if (number > 0 && number < 0xffffffff) said.push(`${number} ${text}`);
    };
    add(worlds.fallen[index], "fell");
    add(worlds.unstable[index], "unstable");
    add(worlds.moved[index], "moved");
    add(worlds.tilted[index], "tilted");
    const of = said.length > 0 ? `${said.join(", ")} of ${plural(world.boxes.id.length, "box")}` : verdict.meaning;
    const layout = worlds.layout[index];
    const weakest = margins?.margin.subarray(4 * layout, 4 * layout + 4);
    return element(
      "section",
      {},
      element(
        "p",
        { class: "title" },
        element("i", { class: `swatch verdict-${world.verdict}` }, verdict.glyph),
        element("span", { class: "strong" }, verdict.name),
        element("span", { class: "faint" }, world.engine),
      ),
      element("p", { class: "soft" }, of),
      ...causes(world.status).map((cause) =>
        element("p", { class: "problem" }, `${cause.meaning} ${cause.cure} ${world.statusText}`.trim()),
      ),
      weakest
        ? element(
            "p",
            { class: "soft" },
            `Stands ${DIRECTIONS.map((d, i) => `${gravities(weakest[i])} ${d}`).join(", ")}.`,
          )
        : null,
      replicas && replicas.count[index] > 0
        ? element(
            "p",
            { class: "soft" },
            `Fails in ${replicas.failed[index]} of ${plural(replicas.count[index], "replica")} with friction that is not known exactly.`,
          )
        : null,
    );
  }

  /** Which box went first, and why. */
  private first(): HTMLElement | null {
    const { derived, world, results } = this;
    const box = derived.moveOrder[0];
    if (box === undefined || !world.series) return null;
    const sample = derived.firstMove[box];
    const after = world.series.time[sample];
    const before = sample > 0 ? world.series.time[sample - 1] : 0;
    const same = derived.moveOrder.filter((other) => derived.firstMove[other] === sample).length - 1;
    return element(
      "section",
      {},
      element("h2", {}, "What went first"),
      element(
        "p",
        {},
        element(
          "button",
          {
            class: "link",
            title: "Go there",
            onclick: () => {
              this.store.update({ box, time: after });
              this.focus(box);
            },
          },
          `Box ${world.boxes.id[box]}`,
        ),
        same > 0 ? ` and ${same} more, ` : ", ",
        sample === 0 ? "at the start." : `between ${before.toFixed(2)} and ${after.toFixed(2)} s.`,
      ),
      ...causeOf(results, world, box, sample).map((sentence) => element("p", { class: "soft" }, sentence)),
    );
  }

  showBox(box: number | null): void {
    this.list.select(box);
    const { boxes, series } = this.world;
    if (box === null || box >= boxes.id.length) {
      this.box.replaceChildren(
        element("h2", {}, "Box"),
        element("p", { class: "faint" }, boxes.id.length > 0 ? "Point at a box, or click it." : "No boxes."),
      );
      return;
    }
    const sample = this.derived.firstMove[box];
    const size = [...boxes.size.subarray(3 * box, 3 * box + 3)].map((side) => String(Number((100 * side).toFixed(1))));
    const [x, y, z] = [...boxes.endDisplacement.subarray(3 * box, 3 * box + 3)].map((part) => (100 * part).toFixed(1));
    const facts: [string, string][] = [
      ["size", `${size.join(" × ")} cm`],
      ["mass", kilograms(boxes.mass[box])],
      ["material", String(boxes.material[box])],
      ["displacement at the end", metres(this.derived.endDistance[box])],
      ["x, y, z in cm", `${x}, ${y}, ${z}`],
      ["largest on the way", metres(boxes.peakDisplacement[box])],
      ["drop", metres(boxes.drop[box])],
      ["tilt", degrees(boxes.endTilt[box])],
      ["largest kinetic energy", joules(boxes.peakEnergy[box])],
      ["moves first", series && sample >= 0 ? seconds(series.time[sample]) : "never"],
    ];
    const verdict = this.derived.verdict[box];
    this.box.replaceChildren(
      element("h2", {}, `Box ${boxes.id[box]}`),
      element(
        "p",
        { class: "title" },
        element("i", { class: `swatch verdict-${verdict}` }, VERDICTS[verdict].glyph),
        element("span", {}, VERDICTS[verdict].name),
        element("span", { class: "faint" }),
        element("button", { class: "plain", title: "Focus (F)", onclick: () => this.focus(box) }, "Focus"),
      ),
      element("dl", {}, ...facts.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)])),
      // What went first has its cause above.
      ...(box === this.derived.moveOrder[0] ? [] : causeOf(this.results, this.world, box, sample)).map((sentence) =>
        element("p", { class: "soft" }, sentence),
      ),
    );
  }

  /** What changes with time: the forces on the walls. */
  showTime(time: number): void {
    const { walls } = this.world;
    if (!walls) return;
    const { sample } = between(times(this.world), time);
    const limited = walls.limit.some((limit) => limit > 0);
    const bars = SIDES.map((side, i) => {
      const now = walls.force[6 * sample + i];
      const limit = walls.limit[i];
      const most = walls.lasting[i];
      const scale = limit > 0 ? limit : Math.max(...walls.lasting, 1);
      const share = (value: number) => `${Math.min(100, (100 * value) / scale).toFixed(1)}%`;
      return element(
        "div",
        { class: limit > 0 && most > limit ? "bar over" : "bar" },
        element("span", {}, side),
        element(
          "span",
          {
            class: "track",
            title: `now ${newtons(now)}, largest over 0.05 s ${newtons(most)}, limit ${newtons(limit)}`,
          },
          element("i", { class: "most", style: `width: ${share(most)}` }),
          element("i", { class: "now", style: `width: ${share(Number.isFinite(now) ? now : 0)}` }),
        ),
        element("span", { class: "value" }, limit > 0 ? `${((100 * most) / limit).toFixed(0)} %` : newtons(most)),
      );
    });
    this.walls.replaceChildren(
      element("h2", {}, limited ? `Walls, share of ${this.results.settings["Screening/Walls"]}` : "Walls"),
      ...bars,
    );
  }

  /** What a box does at a time, in a line beside the pointer. */
  hint(box: number, time: number): string {
    const { boxes, series } = this.world;
    const { sample } = between(times(this.world), time);
    const count = boxes.id.length;
    if (!series) return `box ${boxes.id[box]} · ${metres(this.derived.endDistance[box])} at the end`;
    const at = 3 * (sample * count + box);
    const far = Math.hypot(...series.displacement.subarray(at, at + 3));
    const tilt = tiltOf(series.orientation, 4 * box, 4 * (sample * count + box));
    return `box ${boxes.id[box]} · ${metres(far)} · ${degrees(tilt)}`;
  }
}
