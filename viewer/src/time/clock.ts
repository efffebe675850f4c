import type { Store } from "../ui/state";
import type { TimeControl } from "./time_control";

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4] as const;

/** s: when a picture takes longer, time goes slower rather than past what happens. */
const LONGEST_STEP = 0.1;

/** Plays time: one clock for all that is shown. */
export class Clock implements TimeControl {
  speed = 1;
  private before: number | null = null;
  private readonly listeners = new Set<() => void>();

  /**
   * @param begin s, of the world shown that begins first
   * @param end s, of the one that ends last
   */
  constructor(
    private readonly store: Store,
    readonly begin: number,
    readonly end: number,
  ) {}

  get playing(): boolean {
    return this.before !== null;
  }

  listen(listener: () => void): void {
    this.listeners.add(listener);
  }

  play(): void {
    if (this.playing || this.end <= this.begin) return;
    if (this.store.state.time >= this.end - 1e-9) this.store.update({ time: this.begin });
    this.before = performance.now();
    this.tell();
    requestAnimationFrame((now) => this.step(now));
  }

  pause(): void {
    if (!this.playing) return;
    this.before = null;
    this.tell();
  }

  /** Resolves when it stands. */
  stopped(): Promise<void> {
    return new Promise((resolve) => {
      const listener = () => {
        if (this.playing) return;
        this.listeners.delete(listener);
        resolve();
      };
      this.listeners.add(listener);
      listener();
    });
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  seek(time: number): void {
    this.store.update({ time: Math.min(this.end, Math.max(this.begin, time)) });
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.tell();
  }

  private step(now: number): void {
    if (this.before === null) return;
    const passed = Math.min(LONGEST_STEP, Math.max(0, now - this.before) / 1000);
    const time = this.store.state.time + this.speed * passed;
    this.before = now;
    this.seek(time);
    if (time >= this.end) this.pause();
    else requestAnimationFrame((next) => this.step(next));
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
