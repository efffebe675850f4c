import { element } from "../ui/dom";

/** A number to be slid, with its name and its value as text. */
export class Slider {
  readonly node: HTMLElement;
  private readonly input: HTMLInputElement;
  private readonly value = element("output", {});

  constructor(
    name: string,
    title: string,
    range: { low: number; high: number; step: number; zero: number | null },
    slid: (value: number) => void,
  ) {
    this.input = element("input", {
      type: "range",
      min: range.low,
      max: range.high,
      step: range.step,
      "aria-label": title.replace(/ \(.*\)$/, ""),
      oninput: () => slid(Number(this.input.value)),
      // Its keys are its own.
      onkeydown: (event: KeyboardEvent) => {
        if (/^(Arrow|Page|Home|End)/.test(event.key)) event.stopPropagation();
      },
      ondblclick: () => range.zero !== null && slid(range.zero),
    });
    this.node = element("label", { class: "slider", title }, element("span", {}, name), this.input, this.value);
  }

  show(value: number, text: string, disabled: boolean): void {
    if (Number(this.input.value) !== value) this.input.value = String(value);
    this.input.disabled = disabled;
    this.value.textContent = text;
    this.input.setAttribute("aria-valuetext", text);
  }
}
