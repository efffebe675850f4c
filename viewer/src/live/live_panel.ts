import { boxText } from "../box/box_text";
import { onFloor } from "../data/friction";
import { GRAVITY } from "../data/push";
import type { Results, World } from "../data/results";
import type { Vector } from "../engine/messages";
import { choice, element } from "../ui/dom";
import { fixed, gravities, newtons } from "../ui/text";
import type { LiveDriver } from "./live_driver";
import { bitsSentence } from "./live_words";
import { placed } from "./placing";
import { Slider } from "./slider";

const ACCURACIES = ["screening", "standard", "reference"] as const;
/** Where the load is pushed along each axis, by numbers below 0 and above: the container's acceleration is opposite. */
const AXES = [
  { name: "along", to: ["front", "rear"], title: "Pushes the load to the front or to the rear (← →)" },
  { name: "across", to: ["left", "right"], title: "Pushes the load to the left or to the right (↓ ↑)" },
  { name: "upright", to: ["down", "up"], title: "Pushes the load down or up (page down, page up)" },
] as const;

/** Where a box is. */
const CORNER = [
  { name: "front", from: "From the front wall to the box" },
  { name: "left", from: "From the left side to the box" },
  { name: "floor", from: "From the floor to the box" },
] as const;

/** What the panel does beside driving. */
export interface LiveActions {
  leave(): void;
  save(kind: "load" | "acceleration" | "settings"): void;
}

/** The driver's seat: run and step, acceleration, friction, accuracy, the place of a box, files. */
export class LivePanel {
  readonly node: HTMLElement;
  private readonly run = element("button", { class: "run", onclick: () => this.driver.toggle() });
  private readonly reset = element("button", { onclick: () => this.driver.reset() });
  private readonly state = element("p", { class: "soft speed", role: "status" });
  private readonly bits = element("p", { class: "bits", role: "status" });
  private readonly problem = element("p", { class: "problem", role: "alert" });
  private readonly saved = element("p", { class: "faint saved", role: "status" });
  private readonly axes: Slider[];
  private readonly friction: Slider;
  private readonly source = element("span", { class: "faint" });
  private readonly accuracy: { node: HTMLElement; set: (value: (typeof ACCURACIES)[number]) => void };
  private readonly corner: HTMLInputElement[];
  private readonly boxName = element("h2", {}, "Box");
  private readonly boxHint = element("p", { class: "faint" });
  private box: number | null = null;

  constructor(
    private readonly driver: LiveDriver,
    private readonly file: Results,
    private readonly of: World,
    private readonly version: string,
    actions: LiveActions,
  ) {
    this.axes = AXES.map(
      ({ name, title }, axis) =>
        new Slider(name, title, { low: -1, high: 1, step: 0.01, zero: 0 }, (value) => {
          const next = driver.acceleration;
          // From 0: the bits of the world tell 0 from −0.
          next[axis] = 0 - value * GRAVITY;
          driver.accelerate(next);
        }),
    );
    this.friction = new Slider(
      "μ",
      "Coefficient of friction of all pairs",
      { low: 0, high: 1, step: 0.01, zero: null },
      (value) => driver.setFriction(value),
    );
    this.accuracy = choice(
      "Accuracy",
      ACCURACIES.map((value) => ({ value, label: value })),
      driver.choices.accuracy as (typeof ACCURACIES)[number],
      (accuracy) => {
        driver.choices.accuracy = accuracy;
        driver.rechoose();
      },
    );
    this.corner = CORNER.map(({ from }, axis) =>
      element("input", {
        type: "number",
        step: 0.1,
        "aria-label": `${from}, cm`,
        onchange: () => this.place(axis),
      }),
    );
    const button = (label: string, title: string, onclick: () => void) => element("button", { title, onclick }, label);
    this.node = element(
      "section",
      { class: "drive", "aria-label": "Live" },
      element(
        "p",
        { class: "title" },
        element("span", { class: "strong" }, "Live"),
        element("span", { class: "faint" }, `native ${version}`),
        element(
          "button",
          { class: "plain", title: "Back to the file (L)", "aria-label": "Leave", onclick: actions.leave },
          "×",
        ),
      ),
      element(
        "div",
        { class: "buttons" },
        this.run,
        button("Step", "A sixtieth of a second (.)", () => driver.step()),
        this.reset,
        button("Replay", "The world of the file, unchanged, to its end: are these its bits? (B)", () => {
          driver.restart("replay").then(() => driver.play());
        }),
      ),
      this.state,
      this.bits,
      this.problem,
      element(
        "div",
        { class: "group" },
        element(
          "h2",
          {},
          "Pushed to",
          this.source,
          element(
            "button",
            { class: "plain small", title: "None from now on (0)", onclick: () => driver.accelerate([0, 0, 0]) },
            "none",
          ),
        ),
        ...this.axes.map(({ node }) => node),
      ),
      element("div", { class: "group" }, element("h2", {}, "Contact"), this.friction.node, this.accuracy.node),
      element(
        "div",
        { class: "group" },
        this.boxName,
        element(
          "div",
          { class: "corner" },
          ...this.corner.map((input, axis) => element("label", { title: CORNER[axis].from }, CORNER[axis].name, input)),
          element("span", { class: "faint" }, "cm"),
        ),
        this.boxHint,
      ),
      element(
        "div",
        { class: "group" },
        element("h2", {}, "Save"),
        element(
          "div",
          { class: "buttons" },
          button("Load", "The load as it stood at the start: JSON, which the page and the program read", () =>
            actions.save("load"),
          ),
          button("Acceleration", "An acceleration file of what was driven", () => actions.save("acceleration")),
          button("Settings", "A configuration with friction and accuracy", () => actions.save("settings")),
        ),
        this.saved,
      ),
    );
    this.show();
  }

  /** Pushes the load along an axis by so many g more than now. */
  nudge(axis: number, by: number): void {
    const next: Vector = this.driver.acceleration;
    const push = Math.min(1, Math.max(-1, by - next[axis] / GRAVITY));
    next[axis] = 0 - (Math.round(push * 100) / 100) * GRAVITY;
    this.driver.accelerate(next);
  }

  say(text: string): void {
    this.saved.textContent = text;
  }

  showBox(box: number | null): void {
    this.box = box;
    this.show();
  }

  private place(axis: number): void {
    const { driver, box } = this;
    if (box === null || !driver.atStart || driver.mode === "replay") return;
    const { boxes } = driver.choices;
    const corner = [0, 1, 2].map((of) => (of === axis ? Number(this.corner[of].value) / 100 : boxes[7 * box + of]));
    if (!corner.every(Number.isFinite)) return;
    driver.choices.boxes = placed(boxes, box, corner);
    driver.rechoose();
  }

  /** Brings all of it to how the world is. */
  show(pull = 0): void {
    const { driver } = this;
    const replay = driver.mode === "replay";
    this.run.textContent = driver.playing ? "Pause" : "Run";
    this.run.title = `${driver.playing ? "Pause" : "Run"} (space)`;
    const restores = driver.atStart && !replay && !driver.driven.taken && driver.changed;
    this.reset.textContent = restores ? "Restore" : "Reset";
    this.reset.title = restores
      ? "Layout, friction and accuracy as in the file (R)"
      : "As it was before it started (R)";
    this.state.textContent = this.sentence(pull);
    this.showBits();
    this.problem.textContent = driver.problem;
    this.problem.hidden = driver.problem === "";
    const now = driver.acceleration;
    for (const [axis, slider] of this.axes.entries()) {
      const push = 0 - now[axis] / GRAVITY;
      const to = Math.abs(push) < 0.005 ? "" : ` ${AXES[axis].to[push > 0 ? 1 : 0]}`;
      slider.show(push, gravities(Math.abs(push)) + to, replay);
    }
    this.source.textContent = driver.driven.taken ? "by hand" : "the file's";
    const { friction } = driver.choices;
    const given = replay || friction === null;
    const ofFile = onFloor(this.file.settings);
    const shown = given ? (Number.isFinite(ofFile) ? ofFile : 0.5) : friction;
    this.friction.show(shown, given ? "file" : fixed(shown, 2), replay);
    this.accuracy.set(driver.choices.accuracy as (typeof ACCURACIES)[number]);
    this.showCorner();
  }

  private sentence(pull: number): string {
    const { driver } = this;
    const { shown, possible } = driver.meter;
    const times = (value: number) => `${value >= 9.95 ? value.toFixed(0) : value.toFixed(1)} ×`;
    if (driver.problem !== "") return "It does not start.";
    if (pull > 0) return `Pulls with ${newtons(pull)}.`;
    const could = Number.isFinite(possible) ? `; the engine alone does ${times(possible)}` : "";
    if (driver.playing) return Number.isFinite(shown) ? `${times(shown)} real time${could}.` : "Runs.";
    if (driver.mode === "replay") return driver.hash ? `Replayed to its end${could}.` : "Replays the file.";
    if (driver.unstable) return "The load is unstable under gravity alone: it is not accelerated.";
    return driver.time === 0 ? "Stands at the start." : `Paused at ${driver.time.toFixed(2)} s${could}.`;
  }

  private showBits(): void {
    const { hash } = this.driver;
    this.bits.hidden = hash === null;
    if (hash === null) return;
    const { same, text } = bitsSentence(this.file, this.of, this.version, hash);
    this.bits.className = same ? "bits same" : "bits";
    this.bits.replaceChildren(text, element("code", {}, hash));
  }

  private showCorner(): void {
    const { driver, box } = this;
    const placing = driver.atStart && driver.mode === "drive";
    const boxes = driver.choices.boxes;
    const some = box !== null && 7 * box < boxes.length;
    this.boxName.textContent = some ? boxText(this.of.boxes, box, "Box") : "Box";
    for (const [axis, input] of this.corner.entries()) {
      input.disabled = !some || !placing;
      if (document.activeElement !== input || input.disabled)
        input.value = some ? String(Number((100 * boxes[7 * box + axis]).toFixed(3))) : "";
    }
    this.boxHint.textContent = placing
      ? "Drag a box on its level, or choose it and type its place."
      : driver.mode === "drive"
        ? "Drag a box to pull at it; shift with arrows pushes the chosen one."
        : "Reset ends the replay: then the world can be driven.";
  }
}
