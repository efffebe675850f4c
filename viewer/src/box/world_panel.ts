import { isBeyond, shareOfLimits } from "../data/excursions";
import { UPRIGHT } from "../data/openings";
import { VERDICT_CODES } from "../data/outcome";
import { GRAVITY, pushSentence } from "../data/push";
import { type Container, type Margins, NOT_COUNTED, PRESSED, type Results, type World } from "../data/results";
import { causes, caveatsOf } from "../data/status";
import { isAtLeast, JUDGED_AT_END, meaningOf, NOT_MODELLED, VERDICTS, verdictText } from "../data/verdict";
import { DIRECTIONS, judgedMargins } from "../fleet/rows";
import { boxVerdict } from "../load/quantities";
import { between, tiltOf, times } from "../time/poses";
import { element } from "../ui/dom";
import type { Store } from "../ui/state";
import {
  compared,
  degrees,
  fixed,
  gravities,
  joules,
  kilograms,
  margin,
  metres,
  newtons,
  percent,
  plural,
  seconds,
  waysOf,
} from "../ui/text";
import { BoxList } from "./box_list";
import { boxText } from "./box_text";
import { causeOf } from "./cause";
import { containerFactsOf } from "./container_facts";
import { departureSentences, departuresSentence } from "./departure";

const soft = (text: string) => element("p", { class: "soft" }, text);

/** The numbers of a world: its verdict, the critical box and why it moves, a box, forces on the walls, all boxes. */
export class WorldPanel {
  readonly node: HTMLElement;
  readonly list: BoxList;
  private readonly box = element("section", { class: "box", "aria-live": "polite" });
  private readonly walls = element("section", { class: "walls" });
  private readonly top = element("div", { class: "top" });

  constructor(
    private readonly results: Results,
    private readonly world: World,
    private readonly store: Store,
    private readonly focus: (box: number) => void,
    hover: (box: number | null) => void,
  ) {
    this.list = new BoxList(world, results.judgedAtEnd, (box) => store.update({ box }), hover);
    this.node = element("aside", { class: "panel" }, this.top, this.box, this.walls, this.list.node);
    this.refresh();
    this.showTime(store.state.time);
  }

  /** Shows numbers anew that have changed, as those of a live world do. */
  refresh(orderAnew = true): void {
    this.top.replaceChildren(this.head(), ...this.critical());
    this.list.refresh(orderAnew);
    this.showBox(this.store.state.box);
  }

  private head(): HTMLElement {
    const { world, results } = this;
    const { worlds, margins, replicas, judgedAtEnd } = results;
    const { index, verdict, stopReason } = world;
    const counts = [this.counts(), departuresSentence(results, world)].filter((text) => text !== null);
    return element(
      "section",
      {},
      element(
        "p",
        { class: "title" },
        element("i", { class: `swatch verdict-${verdict}` }, VERDICTS[verdict].glyph),
        element("span", { class: "strong" }, verdictText(verdict, stopReason)),
        element("span", { class: "faint" }, world.engine),
      ),
      soft(meaningOf(verdict, judgedAtEnd)),
      world.accelerated ? soft(pushSentence(world.segments)) : null,
      ...counts.map(soft),
      isAtLeast(verdict, stopReason)
        ? element("p", { class: "notable" }, "It ended when that was decided: what would have followed is not known.")
        : null,
      judgedAtEnd ? element("p", { class: "notable" }, JUDGED_AT_END) : null,
      ...causes(world.status).map((cause) =>
        element("p", { class: "problem" }, `${cause.meaning} ${cause.cure} ${world.statusText}`.trim()),
      ),
      Number.isNaN(worlds.statusTime[index])
        ? null
        : soft(
            `The largest displacement, drop and tilt are of the time before, up to ${seconds(worlds.statusTime[index])}.`,
          ),
      ...caveatsOf(worlds.caveats[index]).map((caveat) => element("p", { class: "notable" }, caveat.meaning)),
      ...(results.ownContainers.has(worlds.layout[index]) ? [soft(containerSentence(world.container))] : []),
      ...(margins ? marginSentences(margins, worlds.layout[index], world).map(soft) : []),
      replicas && replicas.count[index] > 0
        ? soft(
            `Fails in ${replicas.failed[index]} of ${plural(replicas.count[index], "replica")} with friction that is not known exactly.`,
          )
        : null,
      element("p", { class: "faint" }, NOT_MODELLED),
      world.stateHash ? element("p", { class: "faint" }, `State hash ${world.stateHash}`) : null,
    );
  }

  /** How many boxes were beyond which limit; null: none. */
  private counts(): string | null {
    const { world, results } = this;
    const { worlds } = results;
    const { index } = world;
    const fallen = worlds.fallen[index];
    const atEnd = worlds.fallenAtEnd[index];
    const some = (number: number) => number > 0 && number < NOT_COUNTED;
    const said = [
      [worlds.unstable[index], "unstable"],
      [fallen, fallen === atEnd ? "fell" : `fell (${atEnd} at the end)`],
      [worlds.moved[index], "moved"],
      [worlds.tilted[index], "tilted"],
    ] as const;
    const kept = said.filter(([number]) => some(number)).map(([number, what]) => `${number} ${what}`);
    if (kept.length === 0) return null;
    const least = isAtLeast(world.verdict, world.stopReason) ? "at least " : "";
    return `Of ${plural(world.boxes.fixed.filter((fixed) => !fixed).length, "box")} ${least}${kept.join(", ")}.`;
  }

  /** The box that was beyond a limit first, or came nearest to one, and why. */
  private critical(): HTMLElement[] {
    const { world } = this;
    const { boxes, criticalBox } = world;
    const box = criticalBox - 1;
    if (boxes.id.length === 0) return [];
    if (box < 0)
      return [
        element(
          "section",
          {},
          element("h2", {}, "What goes first"),
          element("p", {}, "None: no box has used up 1 % of a limit."),
        ),
      ];
    const first = boxes.firstBeyond[box];
    const beyond = boxVerdict(boxes, box) !== VERDICT_CODES.stayed;
    return [
      element(
        "section",
        {},
        element("h2", {}, beyond ? "What goes first" : "Nearest to a limit"),
        element(
          "p",
          {},
          element(
            "button",
            {
              class: "link",
              title: "Go there",
              onclick: () => {
                this.store.update(Number.isNaN(first) ? { box } : { box, time: first });
                this.focus(box);
              },
            },
            boxText(boxes, box, "Box"),
          ),
          this.whyCritical(box),
        ),
        ...this.story(box),
      ),
    ];
  }

  /** Why a box moves, and how it leaves the container. */
  private story(box: number): HTMLElement[] {
    const { results, world } = this;
    return [...causeOf(results, world, box), ...departureSentences(results, world, box)].map(soft);
  }

  private whyCritical(box: number): string {
    const { world, results } = this;
    const { boxes, index } = world;
    const limits = results.thresholds;
    const first = boxes.firstBeyond[box];
    if (!Number.isNaN(first)) {
      const more = boxes.firstBeyond.filter((time) => time === first).length - 1;
      return `${more > 0 ? ` and ${more} more were` : " was"} beyond a limit first, at ${seconds(first)}.`;
    }
    const settles = results.worlds.unstable[index] > 0;
    const of = settles ? boxes.settling : boxes.judged;
    const sizes = [
      { size: of.displacement[box], limit: limits.move, text: metres, what: "displacement" },
      { size: of.drop[box], limit: limits.drop, text: metres, what: "drop" },
      { size: of.tilt[box], limit: limits.tilt, text: degrees, what: "tilt" },
    ];
    const share = shareOfLimits(of, box, limits);
    const { size, limit, text, what } = sizes.find((one) => one.size / one.limit === share) ?? sizes[0];
    const [far, allowed] = compared(size, limit, text);
    const numbers = `${far} of ${what}, where the limit is ${allowed}${settles ? ", while the load settled" : ""}`;
    return isBeyond(of, box, limits)
      ? ` went farthest beyond a limit: ${numbers}.`
      : ` came nearest to a limit: ${numbers}.`;
  }

  showBox(box: number | null): void {
    this.list.select(box);
    const { boxes } = this.world;
    if (box === null || box >= boxes.id.length) {
      this.box.replaceChildren(
        element("h2", {}, "Box"),
        element("p", { class: "faint" }, boxes.id.length > 0 ? "Point at a box, or click it." : "No boxes."),
      );
      return;
    }
    const isFixed = boxes.fixed[box] === 1;
    const first = boxes.firstBeyond[box];
    const size = [...boxes.size.subarray(3 * box, 3 * box + 3)].map((side) => String(Number((100 * side).toFixed(1))));
    const facts: [string, string][] = [
      ["size, cm", size.join(" × ")],
      ["material", boxes.material[box]],
    ];
    if (Number.isFinite(boxes.mat[box]))
      facts.push(["mat beneath it", `friction ${Number(boxes.mat[box].toPrecision(3))}`]);
    if (Number.isFinite(boxes.bearingLimit[box])) facts.push(["may bear", kilograms(boxes.bearingLimit[box])]);
    const way: [string, string][] = [
      ["mass", kilograms(boxes.mass[box])],
      ["largest displacement", metres(boxes.peak.displacement[box])],
      ["displacement at the end", metres(boxes.end.displacement[box])],
      ...waysOf(boxes.endDisplacement.subarray(3 * box, 3 * box + 3)),
      ["largest drop", metres(boxes.peak.drop[box])],
      ["drop at the end", metres(boxes.end.drop[box])],
      ["largest tilt", degrees(boxes.peak.tilt[box])],
      ["tilt at the end", degrees(boxes.end.tilt[box])],
      ["largest kinetic energy", joules(boxes.peakEnergy[box])],
    ];
    const verdict = boxVerdict(boxes, box);
    if (!this.results.judgedAtEnd)
      way.push([
        "beyond a limit first",
        Number.isNaN(first) && verdict === VERDICT_CODES.stayed ? "never" : seconds(first),
      ]);
    const { damage } = boxes;
    if (damage) {
      const hit = `${gravities(damage.acceleration[box] / GRAVITY)}, ${fixed(damage.velocityChange[box], 2)} m/s`;
      way.push(["hardest impact", damage.beyond[box] ? `${hit}: beyond the boundary` : hit]);
    }
    if (!isFixed) facts.push(...way);
    this.box.replaceChildren(
      element("h2", {}, boxText(boxes, box, "Box")),
      element(
        "p",
        { class: "title" },
        isFixed ? null : element("i", { class: `swatch verdict-${verdict}` }, VERDICTS[verdict].glyph),
        element("span", {}, isFixed ? "fixed" : VERDICTS[verdict].name),
        element("span", { class: "faint" }),
        element("button", { class: "plain", title: "Focus (F)", onclick: () => this.focus(box) }, "Focus"),
      ),
      element("dl", {}, ...facts.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)])),
      ...(isFixed ? [soft("It is part of the container: it never moves, and has no verdict.")] : []),
      // The critical box has its story above.
      ...(box === this.world.criticalBox - 1 ? [] : this.story(box)),
    );
  }

  /** What changes with time: the forces on the walls. */
  showTime(time: number): void {
    const { walls } = this.world;
    if (!walls) return;
    const { sample } = between(times(this.world), time);
    const limited = walls.limit.some((limit) => limit > 0);
    // An open side is nothing that is pressed, and not every container has ground and fixed boxes.
    const { openings } = this.world.container;
    const there = (i: number) => {
      const side = UPRIGHT.findIndex(({ name }) => name === PRESSED[i]);
      if (side >= 0) return openings.walls[side] > 0;
      return PRESSED[i] === "floor" || (PRESSED[i] === "roof" && openings.roof) || walls.lasting[i] > 0;
    };
    const bars = [...walls.lasting.keys()].filter(there).map((i) => {
      const now = walls.force[walls.lasting.length * sample + i];
      const limit = walls.limit[i];
      const most = walls.lasting[i];
      const scale = limit > 0 ? limit : Math.max(...walls.lasting, 1);
      const share = (value: number) => `${Math.min(100, (100 * value) / scale).toFixed(1)}%`;
      return element(
        "div",
        { class: limit > 0 && most > limit ? "bar over" : "bar" },
        element("span", {}, PRESSED[i]),
        element(
          "span",
          {
            class: "track",
            title: `now ${newtons(now)}, largest over 0.05 s ${newtons(most)}${limit > 0 ? `, limit ${newtons(limit)}` : ""}`,
          },
          element("i", { class: "most", style: `width: ${share(most)}` }),
          element("i", { class: "now", style: `width: ${share(Number.isFinite(now) ? now : 0)}` }),
        ),
        element("span", { class: "value" }, limit > 0 ? percent(most / limit) : newtons(most)),
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
    if (boxes.fixed[box]) return `${boxText(boxes, box)} · fixed`;
    if (!series) return `${boxText(boxes, box)} · ${metres(boxes.end.displacement[box])} at the end`;
    const at = 3 * (sample * count + box);
    const far = Math.hypot(...series.displacement.subarray(at, at + 3));
    const tilt = tiltOf(series.orientation, 4 * box, 4 * (sample * count + box));
    return `${boxText(boxes, box)} · ${metres(far)} · ${degrees(tilt)}`;
  }
}

/** The container that a load has of its own. */
const containerSentence = (container: Container) =>
  `In a container of its own: ${containerFactsOf(container)
    .map(([, text]) => text)
    .join("; ")}.`;

/** What a layout stands in each direction, as sentences. */
function marginSentences(margins: Margins, layout: number, { boxes }: World): string[] {
  const own = (all: ArrayLike<number>) => DIRECTIONS.map((_, i) => all[4 * layout + i]);
  const { margin: judged, criticalBox } = judgedMargins(margins);
  // Of a layout that is unstable it is minus what moves it, in all directions.
  if (own(judged)[0] < 0)
    return [`Stands in no direction: ${boxText(boxes, own(criticalBox)[0] - 1)} is unstable under gravity alone.`];
  const list = (all: Float64Array) =>
    own(all)
      .map((value, i) => `${margin(value)} ${DIRECTIONS[i]}`)
      .join(", ");
  const sentences = [`In place, within 5 mm, up to ${list(margins.inPlace.margin)}.`];
  if (margins.withinLimits) sentences.push(`Within the limits up to ${list(margins.withinLimits.margin)}.`);
  return sentences;
}
