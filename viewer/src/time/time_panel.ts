import type { World } from "../data/results";
import { element, oncePerFrame } from "../ui/dom";
import type { Store } from "../ui/state";
import { fixed, seconds, tickText } from "../ui/text";
import { colour } from "../ui/theme";
import { SPEEDS } from "./clock";
import { times } from "./poses";
import { markers, roundStep, type Strip, strips } from "./strips";
import type { TimeControl } from "./time_control";

const FONT = "11px ui-sans-serif, system-ui, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif";
const TOP = 16;
const BOTTOM = 18;
const LEFT = 140;
/** Names of curves stand behind their ends. */
const RIGHT = 40;
/** Names of the strips end here, and leave room for the numbers of their axes. */
const NAMES = LEFT - 44;
/** Pixels between the numbers of the time axis, at least, and between labels of curves. */
const TICK = 56;
const LABEL = 11;
/** Pixels between two strips, whose numbers would touch otherwise. */
const GAP = 14;

/** The time line: curves, samples, when boxes are beyond a limit first, and the place where one is; drag it to go through time. */
export class TimePanel {
  readonly node: HTMLElement;
  private readonly canvas = element("canvas", {
    tabindex: 0,
    role: "slider",
    "aria-label": "Time",
  });
  private readonly context = this.canvas.getContext("2d")!;
  private readonly button = element("button", { class: "play", onclick: () => this.clock.toggle() });
  private readonly readout = element("output", { class: "readout" });
  private strips: Strip[] = [];
  private samples: Float64Array = new Float64Array();
  private marks: { time: number; boxes: number[] }[] = [];
  readonly redraw = oncePerFrame(() => this.draw());

  constructor(
    private readonly world: World,
    private readonly clock: TimeControl,
    private readonly store: Store,
    private readonly live = false,
  ) {
    this.refresh();
    const speed = element(
      "select",
      { "aria-label": "Speed", onchange: () => clock.setSpeed(Number(speed.value)) },
      ...SPEEDS.map((value) => element("option", { value, selected: value === clock.speed }, `${value}×`)),
    );
    clock.listen(() => {
      this.showPlaying();
      speed.value = String(clock.speed);
    });
    this.node = element(
      "section",
      { class: "time", "aria-label": "Time" },
      element("div", { class: "player" }, this.button, speed, this.readout),
      element("div", { class: "line" }, this.canvas),
    );
    this.canvas.addEventListener("pointerdown", (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      clock.pause();
      this.scrub(event);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) this.scrub(event);
    });
    new ResizeObserver(() => this.measure()).observe(this.canvas.parentElement!);
    this.showPlaying();
  }

  /** Takes in samples that have come since. */
  refresh(): void {
    this.samples = times(this.world);
    const last = this.samples[this.samples.length - 1];
    this.strips = strips(this.world, this.samples[0], this.live ? Math.max(last, this.clock.end) : last);
    this.marks = markers(this.world.boxes.firstBeyond);
    this.redraw();
  }

  /** Goes to the next sample, or back. */
  stepSample(step: 1 | -1): void {
    this.stepTo([...this.samples], step);
  }

  /** Goes to the next time at which a box is beyond a limit first, or back. */
  stepMarker(step: 1 | -1): void {
    this.stepTo([this.clock.begin, ...this.marks.map(({ time }) => time), this.clock.end], step);
  }

  private stepTo(stops: number[], step: 1 | -1): void {
    this.clock.pause();
    const { time } = this.store.state;
    const next = step > 0 ? stops.find((stop) => stop > time + 1e-6) : stops.findLast((stop) => stop < time - 1e-6);
    if (next !== undefined) this.clock.seek(next);
  }

  private showPlaying(): void {
    const { playing } = this.clock;
    this.button.textContent = playing ? "❙❙" : "▶";
    this.button.setAttribute("aria-label", playing ? "Pause" : "Play");
    this.button.title = `${playing ? "Pause" : "Play"} (space)`;
  }

  private scrub(event: PointerEvent): void {
    const box = this.canvas.getBoundingClientRect();
    const { begin, end } = this.clock;
    this.clock.seek(begin + ((event.clientX - box.left - LEFT) / (box.width - LEFT - RIGHT)) * (end - begin));
  }

  private measure(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    this.canvas.width = Math.round(clientWidth * devicePixelRatio);
    this.canvas.height = Math.round(clientHeight * devicePixelRatio);
    this.canvas.style.width = `${clientWidth}px`;
    this.canvas.style.height = `${clientHeight}px`;
    this.draw();
  }

  private draw(): void {
    const { context, canvas, store, clock } = this;
    const { time } = store.state;
    const width = canvas.width / devicePixelRatio;
    const height = canvas.height / devicePixelRatio;
    const { begin } = clock;
    const end = clock.end > begin ? clock.end : begin + 1;
    const x = (at: number) => LEFT + ((at - begin) / (end - begin)) * (width - LEFT - RIGHT);
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = FONT;
    context.textBaseline = "middle";

    const simulated = this.world.boxes.id.length > 0;
    const room = Math.min(64, (height - TOP - BOTTOM) / this.strips.length);
    if (simulated)
      for (const [index, strip] of this.strips.entries()) this.drawStrip(strip, TOP + index * room, room - GAP, x);
    if (!this.world.series) {
      context.fillStyle = colour("faint");
      context.textAlign = "center";
      const said = simulated
        ? "No series in this file: boxes go straight from where they stood to where they end, without turning."
        : "This world was not simulated.";
      context.fillText(said, (width + LEFT) / 2, height - BOTTOM - 34);
    }

    // Samples: what is between them is interpolated.
    context.fillStyle = colour("faint");
    if (this.world.series && (width - LEFT - RIGHT) / this.samples.length >= 2)
      for (const sample of this.samples) context.fillRect(x(sample) - 0.5, height - BOTTOM, 1, 4);
    if (!simulated) return;
    this.drawScale(x, begin, end, height);
    for (const mark of this.marks) {
      const at = x(mark.time);
      context.fillStyle = colour("problem");
      context.beginPath();
      context.moveTo(at - 4, 3);
      context.lineTo(at + 4, 3);
      context.lineTo(at, 10);
      context.fill();
    }
    context.fillStyle = colour("ink");
    context.fillRect(x(time) - 0.75, 2, 1.5, height - BOTTOM + 2);
    this.readout.textContent = seconds(time);
    canvas.setAttribute("aria-valuenow", time.toFixed(3));
    canvas.setAttribute("aria-valuemin", begin.toFixed(3));
    canvas.setAttribute("aria-valuemax", end.toFixed(3));
    canvas.setAttribute("aria-valuetext", `${fixed(time, 2)} seconds`);
  }

  private drawScale(x: (at: number) => number, begin: number, end: number, height: number): void {
    const { context } = this;
    const step = roundStep(TICK / (x(1) - x(0)), [1, 2, 5]);
    context.textAlign = "center";
    context.fillStyle = colour("faint");
    for (let tick = Math.ceil(begin / step - 1e-9); tick * step <= end + 1e-9; ++tick)
      context.fillText(tickText(tick * step), x(tick * step), height - 6);
    context.textAlign = "right";
    context.fillStyle = colour("soft");
    context.fillText("time", NAMES - context.measureText(" s").width, height - 6);
    context.fillStyle = colour("faint");
    context.fillText("s", NAMES, height - 6);
  }

  private drawStrip(strip: Strip, top: number, height: number, x: (at: number) => number): void {
    const { context } = this;
    const { ticks, per } = strip;
    const [low, high] = [ticks[0], ticks[ticks.length - 1]];
    const y = (value: number) => top + height - ((value / per - low) / (high - low)) * height;
    context.strokeStyle = colour("line");
    context.lineWidth = 1;
    context.textAlign = "right";
    context.fillStyle = colour("faint");
    for (const tick of ticks) {
      const at = y(tick * per);
      context.beginPath();
      context.moveTo(LEFT, Math.round(at) + 0.5);
      context.lineTo(this.canvas.width / devicePixelRatio - RIGHT, Math.round(at) + 0.5);
      context.stroke();
      context.fillText(tickText(tick), LEFT - 6, at);
    }
    context.fillText(strip.unit, NAMES, top + height / 2 + 7);
    context.fillStyle = colour("soft");
    context.fillText(strip.name, NAMES, top + height / 2 - 6);
    this.drawLabels(strip, top + height, x, y);
    for (const line of strip.lines) {
      context.beginPath();
      for (let i = 0; i < line.time.length; ++i) {
        if (i > 0 && line.steps) context.lineTo(x(line.time[i]), y(line.values[i - 1]));
        context.lineTo(x(line.time[i]), y(line.values[i]));
      }
      context.strokeStyle = colour(line.colour);
      context.lineWidth = 1.5;
      context.stroke();
    }
  }

  /** Names of curves at their ends, where those that end at the same value stand above each other. */
  private drawLabels(strip: Strip, bottom: number, x: (at: number) => number, y: (value: number) => number): void {
    const { context } = this;
    const ends = strip.lines
      .filter(({ label }) => label !== "")
      .map((line) => ({ line, at: Math.min(bottom, y(line.values[line.values.length - 1])) }))
      .sort((a, b) => b.at - a.at);
    context.textAlign = "left";
    for (const [i, { line, at }] of ends.entries()) {
      if (i > 0) ends[i].at = Math.min(at, ends[i - 1].at - LABEL);
      context.fillStyle = colour(line.colour);
      context.fillText(line.label, x(line.time[line.time.length - 1]) + 4, ends[i].at);
    }
  }
}
