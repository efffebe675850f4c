import type { Results } from "../data/results";
import { element, oncePerFrame } from "../ui/dom";
import { colour, onTheme } from "../ui/theme";
import type { Row, Scale } from "./rows";
import { cellOf, columnNames } from "./scales";

export interface CellAt {
  row: number;
  column: number;
}

const ROW = 24;
const LABEL = 300;
const NARROWEST = 26;
const WIDEST = 128;
const FONT = '12px ui-sans-serif, system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif';

/** The matrix of layouts by accelerations: a canvas that draws the rows in sight. */
export class Matrix {
  readonly node: HTMLElement;
  private readonly canvas = element("canvas");
  private readonly spacer = element("div", { class: "spacer" });
  private readonly context = this.canvas.getContext("2d")!;
  private rows: readonly Row[] = [];
  private scale: Scale = "verdict";
  private at: CellAt | null = null;
  /** It has the focus since it opens: nobody has asked for a cell yet. */
  private begins = false;
  private header = 32;
  private cell = WIDEST;
  readonly redraw = oncePerFrame(() => this.draw());

  constructor(
    private readonly results: Results,
    private readonly hover: (at: CellAt | null, place: DOMRect | null) => void,
    private readonly open: (at: CellAt) => void,
  ) {
    this.node = element(
      "div",
      {
        class: "matrix",
        tabindex: 0,
        role: "grid",
        "aria-label": "Layouts by accelerations. Arrow keys move, Enter opens.",
        onscroll: this.redraw,
        onpointermove: (event: PointerEvent) => this.move(this.find(event)),
        onpointerleave: () => this.move(null),
        onclick: (event: PointerEvent) => {
          const at = this.find(event);
          if (at) this.open(at);
        },
        onkeydown: (event: KeyboardEvent) => this.key(event),
        onfocus: () => {
          const told = this.begins || this.at !== null || this.rows.length === 0;
          if (!told && this.node.matches(":focus-visible")) this.move({ row: 0, column: 0 });
        },
      },
      this.canvas,
      this.spacer,
    );
    new ResizeObserver(() => this.measure()).observe(this.node);
    onTheme(this.redraw);
  }

  focus(): void {
    this.begins = true;
    this.node.focus({ preventScroll: true });
    this.begins = false;
  }

  show(rows: readonly Row[], scale: Scale): void {
    this.rows = rows;
    this.scale = scale;
    this.node.setAttribute("aria-rowcount", String(rows.length));
    this.measure();
  }

  /** Puts the cursor on a cell and brings it into sight. */
  move(at: CellAt | null, scroll = false): void {
    if (at?.row === this.at?.row && at?.column === this.at?.column) return;
    this.at = at;
    if (at && scroll) {
      const top = at.row * ROW;
      const room = this.node.clientHeight - this.header;
      if (top < this.node.scrollTop) this.node.scrollTop = top;
      else if (top + ROW > this.node.scrollTop + room) this.node.scrollTop = top + ROW - room;
    }
    this.redraw();
    this.hover(at, at ? this.place(at) : null);
  }

  private get columns(): readonly string[] {
    return columnNames(this.results, this.scale);
  }

  private measure(): void {
    const { clientWidth, clientHeight } = this.node;
    this.context.font = FONT;
    const widest = Math.max(...this.columns.map((name) => this.context.measureText(name).width), 0);
    const room = (clientWidth - this.label() - 24) / Math.max(1, this.columns.length);
    this.cell = Math.min(WIDEST, Math.max(NARROWEST, Math.floor(room)));
    this.header = widest + 16 <= this.cell ? 36 : Math.min(150, Math.ceil(widest * 0.72) + 30);
    this.spacer.style.height = `${this.rows.length * ROW + this.header + 8}px`;
    this.spacer.style.width = `${this.label() + this.columns.length * this.cell + 8}px`;
    const ratio = devicePixelRatio;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    this.canvas.style.width = `${clientWidth}px`;
    this.canvas.style.height = `${clientHeight}px`;
    this.draw();
  }

  private label(): number {
    return Math.min(LABEL, Math.max(150, this.node.clientWidth * 0.32));
  }

  private find(event: PointerEvent): CellAt | null {
    const box = this.node.getBoundingClientRect();
    const x = event.clientX - box.left;
    const y = event.clientY - box.top - this.header;
    if (y < 0) return null;
    const row = Math.floor((y + this.node.scrollTop) / ROW);
    const column = Math.floor((x + this.node.scrollLeft - this.label()) / this.cell);
    if (x < this.label() || row >= this.rows.length || column < 0 || column >= this.columns.length) return null;
    return { row, column };
  }

  private place(at: CellAt): DOMRect {
    const box = this.node.getBoundingClientRect();
    return new DOMRect(
      box.left + this.label() + at.column * this.cell - this.node.scrollLeft,
      box.top + this.header + at.row * ROW - this.node.scrollTop,
      this.cell,
      ROW,
    );
  }

  private key(event: KeyboardEvent): void {
    const page = Math.max(1, Math.floor((this.node.clientHeight - this.header) / ROW) - 1);
    const steps: Record<string, [number, number]> = {
      ArrowUp: [-1, 0],
      ArrowDown: [1, 0],
      ArrowLeft: [0, -1],
      ArrowRight: [0, 1],
      PageUp: [-page, 0],
      PageDown: [page, 0],
      Home: [-this.rows.length, 0],
      End: [this.rows.length, 0],
    };
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = steps[event.key];
    if (step && this.rows.length > 0) {
      const from = this.at ?? { row: Math.floor(this.node.scrollTop / ROW) - step[0], column: -step[1] };
      this.move(
        {
          row: Math.min(this.rows.length - 1, Math.max(0, from.row + step[0])),
          column: Math.min(this.columns.length - 1, Math.max(0, from.column + step[1])),
        },
        true,
      );
    } else if (event.key === "Enter" && this.at) this.open(this.at);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  private draw(): void {
    const { context, node } = this;
    const ratio = devicePixelRatio;
    const width = node.clientWidth;
    const height = node.clientHeight;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = FONT;
    context.textBaseline = "middle";
    const first = Math.floor(node.scrollTop / ROW);
    const last = Math.min(this.rows.length, first + Math.ceil((height - this.header) / ROW) + 1);
    for (let index = first; index < last; ++index) this.drawCells(index, this.header + index * ROW - node.scrollTop);
    // Labels and names stay in sight while cells pass below them.
    context.fillStyle = colour("ground");
    context.fillRect(0, 0, this.label(), height);
    context.fillRect(0, 0, width, this.header);
    context.save();
    context.beginPath();
    context.rect(0, this.header, width, height);
    context.clip();
    for (let index = first; index < last; ++index) this.drawLabel(index, this.header + index * ROW - node.scrollTop);
    context.restore();
    this.drawNames(width);
  }

  private drawCells(index: number, y: number): void {
    const { context } = this;
    for (let column = 0; column < this.columns.length; ++column) {
      const x = this.label() + column * this.cell - this.node.scrollLeft;
      if (x + this.cell < this.label() || x > this.node.clientWidth) continue;
      const cell = cellOf(this.results, this.rows[index], column, this.scale);
      const chosen = this.at?.row === index && this.at.column === column;
      context.beginPath();
      context.roundRect(x + 1, y + 1, this.cell - 2, ROW - 2, 3);
      context.fillStyle = cell?.fill ?? colour("hollow");
      context.fill();
      if (cell?.text) {
        context.fillStyle = cell.ink;
        context.textAlign = "center";
        const text = this.cell < 44 ? cell.text.split(" ")[0] : cell.text;
        if (this.cell >= 44 || this.scale === "verdict") context.fillText(text, x + this.cell / 2, y + ROW / 2 + 0.5);
      }
      if (chosen) {
        context.strokeStyle = colour("ink");
        context.lineWidth = 1.5;
        context.stroke();
      }
    }
  }

  private drawLabel(index: number, y: number): void {
    const { context } = this;
    const row = this.rows[index];
    const right = this.label() - 14;
    context.fillStyle = colour("faint");
    context.textAlign = "right";
    const boxes = String(this.results.layoutBoxes[row.layout] ?? "");
    context.fillText(boxes, right, y + ROW / 2);
    context.fillStyle = this.at?.row === index ? colour("ink") : colour("soft");
    context.textAlign = "left";
    context.fillText(this.fitted(this.results.layouts[row.layout], right - 44), 4, y + ROW / 2);
  }

  private drawNames(width: number): void {
    const { context } = this;
    const upright = this.header === 36;
    context.save();
    context.beginPath();
    context.rect(0, 0, width, this.header);
    context.clip();
    context.fillStyle = colour("faint");
    context.textAlign = "left";
    context.fillText("layout", 4, this.header - 14);
    context.textAlign = "right";
    context.fillText("boxes", this.label() - 14, this.header - 14);
    for (const [column, name] of this.columns.entries()) {
      const x = this.label() + (column + 0.5) * this.cell - this.node.scrollLeft;
      if (x < this.label()) continue;
      context.fillStyle = this.at?.column === column ? colour("ink") : colour("soft");
      context.save();
      context.translate(x, this.header - 14);
      if (upright) {
        context.textAlign = "center";
        context.fillText(name, 0, 0);
      } else {
        context.rotate(-0.8);
        context.textAlign = "left";
        context.fillText(this.fitted(name, 180), -4, 4);
      }
      context.restore();
    }
    context.restore();
  }

  /** A text that fits, cut in its middle: names differ at their ends. */
  private fitted(text: string, width: number): string {
    if (this.context.measureText(text).width <= width) return text;
    let kept = text.length - 1;
    const cut = () => `${text.slice(0, Math.ceil(kept / 2))}…${text.slice(text.length - Math.floor(kept / 2))}`;
    while (kept > 4 && this.context.measureText(cut()).width > width) --kept;
    return cut();
  }
}
