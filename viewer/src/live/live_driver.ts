import type { Results, Segment, World } from "../data/results";
import type { EngineClient } from "../engine/engine_client";
import type { Changes, Frame, LiveInputs, Vector } from "../engine/messages";
import { accelerationAt } from "../time/acceleration";
import type { TimeControl } from "../time/time_control";
import type { Store } from "../ui/state";
import { DrivenAcceleration } from "./driven_acceleration";
import { LiveRecord } from "./live_record";
import { changedSettings, engineSettings } from "./saved_files";
import { SpeedMeter } from "./speed_meter";

/** s: a driven world could go on until then. */
const LONGEST = 3600;
/** s of the picture's time that one picture may take: what takes longer goes slower. */
const LONGEST_STEP = 0.25;
/** s that the time line is longer than what was driven, at least. */
const AHEAD = 2;
/** s of a single step: that of the engine at its least accuracy. */
const STEP = 1 / 60;
/** s between two looks at the boxes, which find their largest displacements: a step of the engine at its standard accuracy. */
const LOOK = 1 / 240;

/** What can be chosen before a world starts. */
export interface Choices {
  /** rows of seven numbers, m */
  boxes: Float64Array;
  accuracy: string;
  /** of all pairs; null: as in the file */
  friction: number | null;
}

/** Whether the world of the file is replayed, or the user drives. */
export type Mode = "replay" | "drive";

/** One world in the engine: started, taken forward with the time of the pictures, changed on the way, and recorded. */
export class LiveDriver implements TimeControl {
  readonly record: LiveRecord;
  readonly meter = new SpeedMeter();
  mode: Mode = "drive";
  readonly begin = 0;
  speed = 1;
  /** what the engine says of inputs that it cannot use */
  problem = "";
  /** of the world that was replayed to its end */
  hash: string | null = null;
  choices: Choices;
  driven: DrivenAcceleration;
  /** what pulls at a box now, asked for before each step */
  force: (time: number) => Changes["force"] = () => undefined;
  private running = false;
  private frictionChanged = false;
  /** the acceleration that the engine has been told of; null: it has that of the file */
  private told: Vector | null = null;
  /** s: where it pauses */
  private stop = LONGEST;
  /** Orders to the engine, one after the other. */
  private last: Promise<unknown> = Promise.resolve();
  private started = 0;
  private readonly listeners = new Set<() => void>();

  constructor(
    private readonly client: EngineClient,
    private readonly file: Results,
    private readonly of: World,
    private readonly store: Store,
    private readonly sampled: () => void,
  ) {
    this.record = new LiveRecord(file, of);
    this.choices = this.fileChoices();
    this.driven = new DrivenAcceleration(of.segments);
  }

  /** What the world of the file was simulated with. */
  fileChoices(): Choices {
    return {
      boxes: this.of.loaded!.boxes.slice(),
      accuracy: this.file.settings["Native/Accuracy"] ?? "standard",
      friction: null,
    };
  }

  /** Whether layout, friction or accuracy are not those of the file. */
  get changed(): boolean {
    const { boxes, accuracy, friction } = this.fileChoices();
    const now = this.choices;
    return now.friction !== friction || now.accuracy !== accuracy || now.boxes.some((value, i) => value !== boxes[i]);
  }

  get playing(): boolean {
    return this.running;
  }

  get time(): number {
    return this.record.time;
  }

  get end(): number {
    if (this.mode === "replay") return this.of.endTime;
    return Math.max(this.latestEnd, Math.ceil(this.time + AHEAD), 5);
  }

  /** s: where a world that nobody drives ends: as that of the file, or after the time that a changed one has to come to rest. */
  private get latestEnd(): number {
    const { of } = this;
    const { settings } = this.file;
    if (!this.changed && of.accelerated) return of.endTime || 0;
    const timeout = settings["Simulation Settings/TimeoutInSeconds"];
    if (timeout) return Number(timeout);
    const ends = of.segments.map(({ start, duration }) => start + duration);
    return Math.max(...ends, 0) + Number(settings["Screening/RunOutSeconds"] ?? 0);
  }

  /** Whether a box is beyond a limit before the start: such a load is not accelerated. */
  get unstable(): boolean {
    return !this.record.world.accelerated;
  }

  /** True before the first step: boxes can be placed. */
  get atStart(): boolean {
    return this.time === 0 && !this.running;
  }

  /** What the container does now, m/s². */
  get acceleration(): Vector {
    return this.driven.at(this.time);
  }

  /** A world that nobody drives pauses at its end. It can go on from there, and one that is driven goes on. */
  private setStop(): void {
    const { latestEnd } = this;
    const follows = !this.driven.taken && this.time < latestEnd;
    if (this.mode === "replay") this.stop = this.of.endTime;
    else this.stop = this.unstable ? 0 : follows ? latestEnd : LONGEST;
  }

  /** Settings of the file, with what the load says of itself. */
  private get given(): Record<string, string> {
    return { ...this.file.settings, ...this.of.loaded!.settings };
  }

  /** The settings of the world; where they are saved, those that repeat it beside its load. */
  settings(mode: Mode, saved = false): LiveInputs["settings"] {
    const given = saved ? this.file.settings : this.given;
    if (mode === "replay") return engineSettings(given, {});
    const { accuracy } = this.choices;
    const changed: Record<string, string> = {
      "Simulation Settings/TimeoutInSeconds": saved ? "" : String(LONGEST),
      "Simulation Settings/StoppingCondition": "timeout",
      "Screening/StopWhen": "end",
      "Native/Accuracy": accuracy,
    };
    return engineSettings(given, { ...changed, ...this.chosenFriction(mode) });
  }

  /** Settings of the friction that was chosen; none where it is that of the file. */
  private chosenFriction(mode: Mode): Record<string, string> {
    const { friction } = this.choices;
    if (mode === "replay" || friction === null) return {};
    const ofPairs = ["BoxBox", "BoxFloor", "BoxWall"].map((pair) => [`Contact/${pair}`, String(friction)]);
    return { "Contact/FrictionModel": "pairs", ...Object.fromEntries(ofPairs) };
  }

  /** What the container did, and will do when nothing is changed. */
  segments(end: number): Segment[] {
    return this.mode === "replay" ? this.of.segments : this.driven.segments(end);
  }

  listen(listener: () => void): void {
    this.listeners.add(listener);
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }

  /** Back to the start; from there, back to layout, friction and accuracy of the file. */
  reset(): Promise<void> {
    if (this.mode === "drive" && this.atStart && !this.driven.taken) this.choices = this.fileChoices();
    return this.restart("drive");
  }

  /** Begins anew with what was chosen. What was driven before the first step still holds. */
  rechoose(): Promise<void> {
    return this.restart("drive", this.atStart && this.mode === "drive");
  }

  /** Starts the world anew, at rest at time 0: that of the file, or what was chosen. */
  restart(mode: Mode, keepDriven = false): Promise<void> {
    this.pause();
    const turn = ++this.started;
    return this.inTurn(async () => {
      if (turn !== this.started) return;
      const { masses, mats } = this.of.loaded!;
      const boxes = mode === "replay" ? this.of.loaded!.boxes : this.choices.boxes;
      const segments = Float64Array.from(
        this.of.segments.flatMap(({ start, duration, value }) => [start, duration, ...value]),
      );
      try {
        // An unstable world of the file has come to its end when it has settled.
        const hashed = mode === "replay" && this.of.endTime <= 0;
        const frame = await this.client.ask("start", {
          boxes,
          segments,
          masses,
          mats,
          settings: this.settings(mode),
          hashed,
        });
        this.mode = mode;
        this.hash = frame.stateHash;
        this.problem = "";
        if (!keepDriven) this.driven = new DrivenAcceleration(this.of.segments);
        this.told = null;
        this.frictionChanged = false;
        this.meter.clear();
        this.record.restart(boxes, frame, this.acceleration);
        this.setStop();
        this.record.world.segments = this.segments(this.end);
        this.store.update({ time: 0 });
        this.sampled();
      } catch (error) {
        this.problem = (error as Error).message;
      }
      this.tell();
    });
  }

  toggle(): void {
    if (this.running) this.pause();
    else this.play();
  }

  play(): void {
    this.setStop();
    if (this.running || this.problem !== "" || this.time >= this.stop) return;
    this.running = true;
    this.store.update({ time: this.time });
    this.tell();
    this.run();
  }

  pause(): void {
    if (!this.running) return;
    this.running = false;
    this.tell();
  }

  /** Takes one step. */
  async step(): Promise<void> {
    this.pause();
    this.setStop();
    const to = this.time + STEP;
    while (this.problem === "" && this.time < Math.min(to, this.stop) - 1e-9) await this.advance(to);
    this.store.update({ time: this.time });
    this.tell();
  }

  /** Looks back at what was simulated, while it does not run. */
  seek(time: number): void {
    if (!this.running) this.store.update({ time: Math.min(this.time, Math.max(0, time)) });
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.meter.clear();
    this.tell();
  }

  /** m/s², from now on. */
  accelerate(value: Vector): void {
    if (this.mode === "replay") return;
    this.driven.set(this.time, value);
    this.setStop();
    this.record.world.segments = this.segments(this.end);
    this.tell();
  }

  /** Of all pairs, from now on; before the start also while the load settles. */
  setFriction(value: number): void {
    this.choices.friction = value;
    this.frictionChanged = !this.atStart;
    this.setStop();
    if (this.atStart) this.rechoose();
    this.tell();
  }

  private async run(): Promise<void> {
    let before = performance.now();
    let due = this.time;
    while (this.running) {
      const now = await new Promise<number>((go) => requestAnimationFrame(go));
      // A picture that is late is followed by one that is early: no time is lost between them.
      due = Math.max(due, this.time) + this.speed * Math.min(LONGEST_STEP, Math.max(0, now - before) / 1000);
      before = Math.max(before, now);
      while (this.running && this.time < Math.min(due - 1e-9, this.stop)) await this.advance(due);
      this.meter.picture(performance.now() / 1000, this.time);
      this.store.update({ time: this.time });
      if (this.time >= this.stop) this.pause();
    }
  }

  /** Until a time, the next look, sample or the end, whichever comes first; a pull changes with each step. */
  private advance(wanted: number): Promise<void> {
    return this.inTurn(async () => {
      const { record } = this;
      const changes = this.changes();
      const to = Math.min(wanted, record.nextSample, this.stop, record.time + (changes.force ? STEP : LOOK));
      const ends = to >= this.stop;
      try {
        const frame = await this.client.ask("advance", { to, changes, hashed: ends && this.mode === "replay" });
        this.meter.step(frame.time - record.time, frame.computed);
        this.take(frame);
        if (changes.force) this.store.update({ time: frame.time });
      } catch (error) {
        this.problem = (error as Error).message;
        this.pause();
      }
    });
  }

  private changes(): Changes {
    if (this.mode === "replay") return {};
    const { friction } = this.choices;
    const changes: Changes = { force: this.force(this.time) };
    // The engine takes a step of its own after each change: it is told of real ones only.
    const { latest } = this.driven;
    if (latest?.some((part, axis) => part !== this.told?.[axis])) changes.acceleration = this.told = latest;
    if (this.frictionChanged && friction !== null) changes.friction = friction;
    this.frictionChanged = false;
    return changes;
  }

  private take(frame: Frame): void {
    const { record } = this;
    record.world.segments = this.segments(this.end);
    // Sentences about the cause compare with the friction that acts.
    record.results.settings = changedSettings(this.given, this.chosenFriction(this.mode));
    // At a change, the value before it, as in a results file.
    const acceleration = accelerationAt(record.world.segments, frame.time - 1e-9);
    if (frame.stateHash !== null) this.hash = frame.stateHash;
    const sampled = record.add(frame, acceleration);
    if (sampled) this.sampled();
  }

  private inTurn<T>(work: () => Promise<T>): Promise<T> {
    const done = this.last.then(work);
    this.last = done.catch(() => {});
    return done;
  }
}
