/** s of the clock on the wall over which speed is shown */
const WINDOW = 1.5;

/** How fast a live world goes: seconds of it per second. */
export class SpeedMeter {
  private readonly pictures: { wall: number; time: number }[] = [];
  private simulated = 0;
  private computed = 0;

  clear(): void {
    this.pictures.length = 0;
    this.simulated = 0;
    this.computed = 0;
  }

  picture(wall: number, time: number): void {
    this.pictures.push({ wall, time });
    while (this.pictures.length > 2 && this.pictures[0].wall < wall - WINDOW) this.pictures.shift();
  }

  /** Both in s: what was simulated, and how long the engine took. */
  step(simulated: number, computed: number): void {
    this.simulated += simulated;
    this.computed += computed;
  }

  /** As seen on the page, over the last moments; NaN: not known yet. */
  get shown(): number {
    const [first, last] = [this.pictures[0], this.pictures[this.pictures.length - 1]];
    return first && last.wall > first.wall ? (last.time - first.time) / (last.wall - first.wall) : Number.NaN;
  }

  /** What the engine alone would do, since the start. */
  get possible(): number {
    return this.computed > 0 ? this.simulated / this.computed : Number.NaN;
  }
}
