import { type PoseSource, Poses } from "../time/poses";
import type { LiveDriver } from "./live_driver";
import { centresOf } from "./live_record";

/** Where the boxes of a live world are: now, at an earlier time of it, or where they are put before it starts. */
export class LivePoses implements PoseSource {
  readonly displacement: Float32Array;
  readonly rotation: Float32Array;
  private readonly past: Poses;

  constructor(private readonly driver: LiveDriver) {
    this.past = new Poses(driver.record.world);
    this.displacement = new Float32Array(driver.record.displacement.length);
    this.rotation = new Float32Array(driver.record.orientation.length);
  }

  set(time: number): void {
    const { record } = this.driver;
    if (time < record.time - 1e-9) {
      this.past.set(time);
      this.displacement.set(this.past.displacement);
      this.rotation.set(this.past.rotation);
      return;
    }
    this.displacement.set(record.displacement);
    const { orientation } = record;
    for (let q = 0; q < orientation.length; q += 4)
      this.rotation.set([orientation[q + 1], orientation[q + 2], orientation[q + 3], orientation[q]], q);
    if (this.driver.atStart) this.put();
  }

  /** Adds how far boxes were moved in the layout since the world was started. */
  private put(): void {
    const { record, choices } = this.driver;
    if (this.driver.mode === "replay" || record.boxes.length !== choices.boxes.length) return;
    const now = centresOf(choices.boxes, {});
    const then = centresOf(record.boxes, {});
    for (let i = 0; i < now.length; ++i) this.displacement[i] += now[i] - then[i];
  }
}
