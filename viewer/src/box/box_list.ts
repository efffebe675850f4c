import type { World } from "../data/results";
import { boxVerdict } from "../load/quantities";
import { element, oncePerFrame } from "../ui/dom";
import { degrees, metres, seconds } from "../ui/text";

const ROW = 24;

type Order = "id" | "name" | "first" | "moved" | "tilt" | "drop";

const COLUMNS: readonly { order: Order; name: string; title: string; titleAtEnd: string }[] = [
  {
    order: "id",
    name: "box",
    title: "Position in the layout file, from 1",
    titleAtEnd: "Position in the layout file, from 1",
  },
  { order: "name", name: "name", title: "Name of the box in the load", titleAtEnd: "Name of the box in the load" },
  {
    order: "first",
    name: "first",
    title: "When it was beyond a limit first, s",
    titleAtEnd: "When it was beyond a limit first: a file of an earlier version does not say",
  },
  { order: "moved", name: "moved", title: "Largest displacement", titleAtEnd: "Displacement at the end" },
  { order: "tilt", name: "tilt", title: "Largest angle of rotation", titleAtEnd: "Rotation at the end" },
  {
    order: "drop",
    name: "drop",
    title: "By how much it was lower at most",
    titleAtEnd: "How much lower it is at the end",
  },
];

/** All boxes of a world as a table, of which only the rows in sight exist. */
export class BoxList {
  readonly node: HTMLElement;
  private readonly head = element("div", { class: "row head", role: "row" });
  private readonly body = element("div", { class: "rows" });
  private readonly scroller: HTMLElement;
  private sorted: number[] = [];
  private selected: number | null = null;
  private order: Order = "moved";
  private readonly named: boolean;
  private readonly redraw = oncePerFrame(() => this.draw());

  constructor(
    private readonly world: World,
    private readonly judgedAtEnd: boolean,
    private readonly choose: (box: number) => void,
    private readonly hover: (box: number | null) => void,
  ) {
    this.named = world.boxes.name.some((name) => name !== "");
    this.scroller = element(
      "div",
      {
        class: "scroller",
        tabindex: 0,
        role: "listbox",
        "aria-label": "Boxes. Arrow keys choose one.",
        onscroll: this.redraw,
        onkeydown: (event: KeyboardEvent) => this.key(event),
      },
      this.body,
    );
    this.node = element("section", { class: this.named ? "boxes named" : "boxes" }, this.head, this.scroller);
    new ResizeObserver(this.redraw).observe(this.scroller);
    this.sort("moved");
  }

  /** Takes in numbers that have changed; `anew` also puts the rows in order, where the user does not go through them. */
  refresh(anew: boolean): void {
    if (anew && document.activeElement !== this.scroller) this.sort(this.order);
    else this.redraw();
  }

  select(box: number | null): void {
    if (box === this.selected) return;
    this.selected = box;
    const at = box === null ? -1 : this.sorted.indexOf(box);
    if (at >= 0) {
      const { scrollTop, clientHeight } = this.scroller;
      if (at * ROW < scrollTop || (at + 1) * ROW > scrollTop + clientHeight)
        this.scroller.scrollTop = Math.max(0, at * ROW - clientHeight / 2);
    }
    this.redraw();
  }

  private sort(order: Order): void {
    if (order !== this.order) this.scroller.scrollTop = 0;
    this.order = order;
    const { boxes } = this.world;
    const { displacement, tilt, drop } = boxes.judged;
    const { firstBeyond } = boxes;
    const places = order === "name" ? placesOf(boxes.name) : null;
    const key: Record<Order, (box: number) => number> = {
      id: (box) => boxes.id[box],
      name: (box) => places?.[box] ?? box,
      first: (box) => (Number.isNaN(firstBeyond[box]) ? Number.MAX_SAFE_INTEGER : firstBeyond[box]),
      moved: (box) => -displacement[box],
      tilt: (box) => -tilt[box],
      drop: (box) => -drop[box],
    };
    this.sorted = [...boxes.id.keys()].sort((a, b) => key[order](a) - key[order](b) || a - b);
    this.head.replaceChildren(
      ...COLUMNS.filter(({ order: of }) => this.named || of !== "name").map((column) =>
        element(
          "button",
          {
            class: "plain",
            title: this.judgedAtEnd ? column.titleAtEnd : column.title,
            "aria-pressed": undefined,
            "data-sorted": column.order === order,
            onclick: () => this.sort(column.order),
          },
          column.name,
        ),
      ),
    );
    this.body.style.height = `${this.sorted.length * ROW}px`;
    this.redraw();
  }

  private key(event: KeyboardEvent): void {
    const step = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    if (step === 0 || this.sorted.length === 0) return;
    const from = this.selected === null ? -step : this.sorted.indexOf(this.selected);
    const next = Math.min(this.sorted.length - 1, Math.max(0, from + step));
    this.choose(this.sorted[next]);
    event.preventDefault();
    event.stopPropagation();
  }

  private draw(): void {
    const first = Math.floor(this.scroller.scrollTop / ROW);
    const last = Math.min(this.sorted.length, first + Math.ceil(this.scroller.clientHeight / ROW) + 1);
    const { boxes } = this.world;
    const { firstBeyond } = boxes;
    const { displacement, tilt, drop } = boxes.judged;
    const rows: HTMLElement[] = [];
    for (let at = first; at < last; ++at) {
      const box = this.sorted[at];
      rows.push(
        element(
          "div",
          {
            class: "row",
            role: "option",
            "aria-selected": box === this.selected ? "true" : "false",
            style: `top: ${at * ROW}px`,
            onclick: () => this.choose(box),
            onpointerenter: () => this.hover(box),
            onpointerleave: () => this.hover(null),
          },
          element("span", {}, element("i", { class: `dot verdict-${boxVerdict(boxes, box)}` }), String(boxes.id[box])),
          this.named ? element("span", { class: "name", title: boxes.name[box] }, boxes.name[box]) : null,
          element("span", {}, boxes.fixed[box] ? "fixed" : firstText(firstBeyond[box])),
          element("span", {}, short(displacement[box], metres)),
          element("span", {}, tilt[box] < 0.05 ? "" : degrees(tilt[box])),
          element("span", {}, short(drop[box], metres)),
        ),
      );
    }
    this.body.replaceChildren(...rows);
  }
}

const collator = new Intl.Collator("en", { numeric: true });

/** The place of each name in their order. */
function placesOf(names: readonly string[]): number[] {
  const places: number[] = [];
  for (const [place, box] of [...names.keys()].sort((a, b) => collator.compare(names[a], names[b])).entries())
    places[box] = place;
  return places;
}

const firstText = (time: number) => (Number.isNaN(time) ? "" : seconds(time).replace(" s", ""));

/** Nothing where next to nothing happened: what is left stands out. */
const short = (value: number, text: (value: number) => string) => (Math.abs(value) < 0.0005 ? "" : text(value));
