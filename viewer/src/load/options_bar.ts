import type { Results, World } from "../data/results";
import { choice, element } from "../ui/dom";
import { type LegendEntry, legendItems } from "../ui/legend";
import type { Store, ViewState } from "../ui/state";
import { type Colouring, colouringsOf } from "./colouring";

type Switch = "ghost" | "traces" | "centre";

const SWITCHES: { key: Switch; label: string; title: string }[] = [
  { key: "ghost", label: "Ghost", title: "Outlines of where boxes stood (G)" },
  { key: "traces", label: "Traces", title: "Paths of the boxes that moved (T)" },
  { key: "centre", label: "Centre", title: "Centre of gravity, before and now (C)" },
];

/** What the picture shows, and from where. */
export class OptionsBar {
  readonly node: HTMLElement;
  private readonly legendNode = element("ul", { class: "colours" });
  private readonly buttons = new Map<Switch, HTMLElement>();
  private readonly ranges: { key: "exploded" | "clip"; input: HTMLInputElement }[] = [];
  private readonly colouring: { node: HTMLElement; set: (value: Colouring) => void };

  constructor(results: Results, world: World, store: Store, extra: HTMLElement[]) {
    const { state } = store;
    this.colouring = choice<Colouring>("Colour", colouringsOf(results, world), state.colouring, (colouring) =>
      store.update({ colouring }),
    );
    for (const { key, label, title } of SWITCHES)
      this.buttons.set(
        key,
        element("button", { title, onclick: () => store.update({ [key]: !store.state[key] }) }, label),
      );
    const range = (key: "exploded" | "clip", label: string, title: string) => {
      const input = element("input", {
        type: "range",
        min: 0,
        max: 1,
        step: 0.01,
        "aria-label": title,
        oninput: () => store.update({ [key]: Number(input.value) }),
      });
      this.ranges.push({ key, input });
      return element("label", { class: "choice", title }, element("span", {}, label), input);
    };
    this.node = element(
      "div",
      { class: "options" },
      this.colouring.node,
      this.legendNode,
      element("span", { class: "gap" }),
      ...extra,
      ...this.buttons.values(),
      range("exploded", "Apart", "Move boxes apart"),
      range("clip", "Cut", "Cut away what is behind a plane along the length, from the door"),
    );
    this.show(state);
  }

  show(state: ViewState): void {
    this.colouring.set(state.colouring);
    for (const [key, button] of this.buttons) button.setAttribute("aria-pressed", String(state[key]));
    for (const { key, input } of this.ranges) if (Number(input.value) !== state[key]) input.value = String(state[key]);
  }

  legend(entries: LegendEntry[]): void {
    this.legendNode.replaceChildren(...legendItems(entries));
  }
}
