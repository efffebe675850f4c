import type { Load } from "holdfast-engine";
import { boxText } from "../box/box_text";
import { UPRIGHT } from "../data/openings";
import type { World } from "../data/results";
import { element } from "../ui/dom";
import { BoxForm } from "./box_form";
import { withOneMore } from "./free_place";
import { against, changed, leftFloating, MAT, moved, swapped, turned, withMats, without } from "./load_edits";

/** m that a press of a button moves a box. */
const STEPS = [0.01, 0.1] as const;
/** That of them which was chosen, for all boxes. */
let chosenStep: (typeof STEPS)[number] = STEPS[1];
const stepText = () => `by ${100 * chosenStep} cm`;

/** Puts a load in the place of the old one; where `make` throws, the user is told why. */
export type Edit = (make: (load: Load) => Load, choose?: number) => void;

/** What can be done with the chosen box. */
export class BoxTools {
  readonly node = element("div");
  /** the box that is to change places with another one; null: none */
  private swapping: number | null = null;
  private box: number | null = null;
  private readonly swapHint = element("p", { class: "faint", "aria-live": "polite" });

  /**
   * @param load      as it is now
   * @param materials identifier of the list of those to choose from
   */
  constructor(
    private readonly world: World,
    private readonly load: () => Load,
    private readonly materials: string,
    private readonly edit: Edit,
  ) {}

  /** Shows another box; null: none is chosen. */
  show(box: number | null): void {
    this.box = box;
    const of = box === null ? undefined : this.load().boxes[box];
    if (box === null || !of) {
      const none = element("p", { class: "faint" }, "Choose a box to move, turn, copy, swap or take it away.");
      this.node.replaceChildren(none, this.swapHint);
      return;
    }
    const size = this.world.container.size;
    const button = (text: string, title: string, make: (load: Load) => Load, does = text) =>
      element("button", { title, "data-does": does, onclick: () => this.edit(make) }, text);
    const by = (axis: number, sign: number) => (load: Load) => moved(load, box, axis, sign * chosenStep);
    const step = element(
      "button",
      {
        title: "How far a press moves it",
        "data-does": "step",
        onclick: () => {
          chosenStep = STEPS[(STEPS.indexOf(chosenStep) + 1) % STEPS.length];
          step.textContent = stepText();
        },
      },
      stepText(),
    );
    const form = new BoxForm("What the load says of the box", of, this.world.boxes.mass[box], false, this.materials, {
      word: "Change",
      act: () => this.edit((load) => changed(load, box, form.said())),
    });
    this.node.replaceChildren(
      element("p", { class: "strong" }, boxText(this.world.boxes, box, "Box")),
      element(
        "div",
        { class: "buttons" },
        step,
        ...UPRIGHT.map(({ name, axis, far }) => button(name, `Moves it to the ${name}`, by(axis, far ? 1 : -1))),
        button("up", "Moves it up", by(2, 1)),
        button("down", "Moves it down", by(2, -1)),
      ),
      element(
        "div",
        { class: "buttons" },
        ...UPRIGHT.map((side) =>
          button(`→| ${side.name}`, `To the ${side.name}, until it touches`, (load) => against(load, box, side, size)),
        ),
      ),
      element(
        "div",
        { class: "buttons" },
        button("Turn", "Exchanges length and width", (load) => turned(load, box)),
        of.mat === undefined
          ? button("Mat beneath it", `An anti-slip mat, friction ${MAT}`, (load) => withMats(load, [box], MAT), "mat")
          : button("Without its mat", "Takes the mat away", (load) => withMats(load, [box], undefined), "mat"),
        button("Take away", "Leaves the box out", (load) => without(load, box)),
      ),
      element("div", { class: "buttons" }, this.copyButton(box), this.swapButton(box)),
      this.swapHint,
      element("details", {}, element("summary", {}, "Name, mass, material"), form.node),
    );
  }

  private copyButton(box: number): HTMLElement {
    // Nobody has said when the copy is loaded.
    const copied = (load: Load) =>
      placedFirst(load, { ...load.boxes[box], order: undefined }, this.world.container.size);
    return element(
      "button",
      {
        title: "Another box of the same kind, at the first place where it stands",
        "data-does": "copy",
        onclick: () => this.edit(copied, this.load().boxes.length),
      },
      "Copy",
    );
  }

  /** Remembers a box, and changes its place with that of the box that is chosen when it is pressed again. */
  private swapButton(box: number): HTMLElement {
    const other = this.swapping;
    const name = (index: number) => boxText(this.world.boxes, index);
    const isFirst = other === null || other === box;
    const size = this.world.container.size;
    const swap = element(
      "button",
      {
        title: isFirst ? "Changes its place with that of another box" : "Each of the two takes the other's place",
        "data-does": "swap",
        "aria-pressed": isFirst ? String(other === box) : undefined,
        onclick: () => {
          if (!isFirst) return this.edit((load) => swappedInPlace(load, other, box, size, name));
          this.swapping = this.swapping === box ? null : box;
          swap.setAttribute("aria-pressed", String(this.swapping === box));
          this.showHint();
        },
      },
      isFirst ? "Swap" : `Swap with ${name(other)}`,
    );
    this.showHint();
    return swap;
  }

  private showHint(): void {
    const { swapping, box } = this;
    this.swapHint.hidden = swapping === null || swapping !== box;
    if (swapping !== null)
      this.swapHint.textContent = `Choose the box that ${boxText(this.world.boxes, swapping)} swaps places with, and press Swap again.`;
  }
}

/** The load with one more box, its last one; where there is no place for it, an error says so. */
export function placedFirst(load: Load, box: Load["boxes"][number], size: readonly number[]): Load {
  const placed = withOneMore(load, box, size);
  if (placed) return placed;
  const sides = [0, 1, 2].map((axis) => Number((100 * (box.corner_max[axis] - box.corner_min[axis])).toFixed(1)));
  throw new Error(`There is no place where a box of ${sides.join(" × ")} cm stands.`);
}

/** The load with two boxes in each other's place; where one would be left without anything beneath it, an error says so. */
function swappedInPlace(
  load: Load,
  a: number,
  b: number,
  size: readonly number[],
  name: (box: number) => string,
): Load {
  const next = swapped(load, a, b, size);
  const [first, ...more] = leftFloating(load, next);
  if (first === undefined) return next;
  const others = more.length > 0 ? ` and ${more.length} more` : "";
  throw new Error(`Nothing would be beneath ${name(first)}${others}.`);
}
