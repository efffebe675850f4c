import { SaveResults } from "../save/save_results";
import { element, oncePerFrame } from "../ui/dom";
import { seconds } from "../ui/text";
import type { Screening } from "./screening";

/** How far a screening is, above its matrix, with what ends it and what becomes of it. */
export class ProgressBar {
  readonly node: HTMLElement;
  private readonly bar = element("progress", { max: 1, "aria-label": "Screening" });
  private readonly text = element("span", { role: "status" });
  private readonly problem = element("span", { class: "problem", role: "alert" });
  private readonly cancel: HTMLButtonElement;
  private readonly saving: SaveResults;

  constructor(
    private readonly screening: Screening,
    settings: () => void,
  ) {
    this.cancel = element("button", { onclick: () => screening.cancel() }, "Cancel");
    this.saving = new SaveResults(screening, (problem) => {
      this.problem.textContent = problem;
    });
    this.node = element(
      "div",
      { class: "progress" },
      this.bar,
      this.text,
      this.problem,
      element("span", { class: "gap" }),
      this.cancel,
      this.saving.node,
      element("button", { onclick: settings, title: "Files, norm, container, friction, limits" }, "Settings"),
    );
    screening.listen(oncePerFrame(() => this.show()));
    this.show();
  }

  private show(): void {
    const { worldsDone, worlds, marginsDone, margins, seconds: took, running, problem } = this.screening.progress;
    const all = worlds + margins;
    this.bar.hidden = this.cancel.hidden = !running;
    this.saving.disabled = running;
    this.bar.value = all > 0 ? (worldsDone + marginsDone) / all : 1;
    const of = (done: number, total: number) => (done === total ? String(total) : `${done} of ${total}`);
    const parts = [`${of(worldsDone, worlds)} ${worlds === 1 ? "world" : "worlds"}`];
    if (margins > 0) parts.push(`margins of ${of(marginsDone, margins)} ${margins === 1 ? "load" : "loads"}`);
    const left = running
      ? ""
      : worldsDone + marginsDone < all
        ? `, ended after ${seconds(took)}`
        : ` in ${seconds(took)}`;
    this.text.textContent = `${parts.join(", ")}${left}`;
    this.problem.textContent = problem;
  }
}
