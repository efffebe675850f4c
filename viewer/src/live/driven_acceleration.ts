import type { Segment } from "../data/results";
import type { Vector } from "../engine/messages";
import { accelerationAt } from "../time/acceleration";

/** What the container does: as in the file, until the driver takes over; from then on as was driven. Times do not go back. */
export class DrivenAcceleration {
  private readonly changes: { time: number; value: Vector }[] = [];

  constructor(private readonly file: readonly Segment[]) {}

  /** Whether the driver has taken over. */
  get taken(): boolean {
    return this.changes.length > 0;
  }

  /** The latest change; null: it is as in the file. */
  get latest(): Vector | null {
    const last = this.changes[this.changes.length - 1];
    return last ? [...last.value] : null;
  }

  /** m/s², from a time on that is not before the latest change. */
  at(time: number): Vector {
    return this.latest ?? accelerationAt(this.file, time);
  }

  /** From a time on; a second change at the same time takes the place of the first. */
  set(time: number, value: Vector): void {
    const last = this.changes[this.changes.length - 1];
    if (last && time <= last.time) last.value = [...value];
    else if (!last?.value.every((part, axis) => part === value[axis])) this.changes.push({ time, value: [...value] });
  }

  /** The same as segments that go on until a time. */
  segments(end: number): Segment[] {
    const taken = Math.min(this.changes[0]?.time ?? end, end);
    const list: Segment[] = this.file
      .filter(({ start }) => start < taken)
      .map(({ start, duration, value }) => ({
        start,
        duration: start + duration <= taken ? duration : taken - start,
        value: [...value],
      }));
    const last = list[list.length - 1];
    const goes = last ? last.start + last.duration : 0;
    if (goes < taken) list.push({ start: goes, duration: taken - goes, value: [0, 0, 0] });
    for (const [index, { time, value }] of this.changes.entries()) {
      const until = Math.min(this.changes[index + 1]?.time ?? end, end);
      if (until > time) list.push({ start: time, duration: until - time, value: [...value] });
    }
    return list;
  }
}
