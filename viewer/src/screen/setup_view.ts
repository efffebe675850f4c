import type { Problem, ReadLoad, Shape } from "holdfast-engine";
import { element } from "../ui/dom";
import { count, plural } from "../ui/text";
import { columnsOption, MEANINGS, type Puzzle } from "./column_choices";
import {
  advicesOf,
  type FileChoices,
  fileChoicesText,
  NORM_SIZES,
  normChoice,
  OWN_SIZE,
  type RunChoices,
  takesSize,
} from "./run_choices";
import type { Reading, Setup } from "./setup";

type Key = Exclude<keyof RunChoices, "margins">;

/** What messages are about: a file, or a sheet of one. */
interface Of {
  name: string;
  isSheet: boolean;
}

/** Messages of a load that are shown; the others are counted. */
const MOST_MESSAGES = 5;

const sizeText = ({ size }: Shape) => `${size.map((side) => Number(side.toFixed(3))).join(" × ")} m`;

/** What is to be screened, and with what: one screen, from files to the button. */
export class SetupView {
  readonly node: HTMLElement;
  private readonly loads = element("section", { class: "loads", "aria-live": "polite" });
  private readonly form = element("form", { class: "choices", onsubmit: (event: Event) => event.preventDefault() });
  private readonly screen: HTMLButtonElement;
  private readonly problem = element("p", { class: "problem", role: "alert" });
  private readonly notes = new Map<string, HTMLElement>();
  private readonly fields = new Map<Key, HTMLInputElement | HTMLSelectElement>();
  private readonly own: HTMLElement;
  private readonly normSize: HTMLElement;
  /** headers of tables whose columns are being explained */
  private readonly explained = new Set<string>();

  constructor(
    private readonly setup: Setup,
    choose: () => void,
    start: () => void,
  ) {
    const { catalogue } = setup;
    this.screen = element("button", { class: "primary", type: "button", onclick: start }, "Screen");
    this.own = element(
      "div",
      { class: "own" },
      this.number("length", "Length, m"),
      this.number("width", "Width, m"),
      this.number("height", "Height, m"),
    );
    this.normSize = this.number("normSize", `Size K, g, ${NORM_SIZES.join(" to ")}`);
    const pairs = catalogue.friction.flatMap(({ name, materials, dry, wet }) => [
      { value: name, label: `${materials}: ${dry}` },
      ...(wet !== null && wet !== dry ? [{ value: `${name}-wet`, label: `${materials}, wet: ${wet}` }] : []),
    ]);
    const friction = (key: Key, label: string) => this.choice(key, label, [{ value: "", label: "0.5" }, ...pairs]);
    this.form.append(
      this.part(
        "Accelerations",
        this.choice(
          "norm",
          "Norm",
          catalogue.norms.map((norm) => ({
            value: normChoice(norm.name, norm.takesSize),
            label: `${norm.name}: ${norm.numbers}`,
          })),
        ),
        this.normSize,
        this.note("norm"),
      ),
      this.part(
        "Container",
        this.choice("container", "Type", [
          { value: "", label: "as each load says" },
          ...catalogue.containers.map(({ name, what, shape }) => ({
            value: name,
            label: `${name}: ${what}, ${sizeText(shape)}`,
          })),
          { value: OWN_SIZE, label: "another size…" },
        ]),
        this.own,
        this.note("container"),
      ),
      this.part(
        "Friction",
        friction("floor", "Boxes on the floor"),
        friction("boxes", "Boxes on boxes"),
        friction("walls", "Boxes on walls"),
        element(
          "p",
          { class: "faint" },
          `Source: ${catalogue.frictionSource}. Mats and materials of a file come first.`,
        ),
      ),
      this.part(
        "Limits",
        this.number("move", "Displacement, cm"),
        this.number("drop", "Drop, cm"),
        this.number("tilt", "Tilt, °"),
      ),
      this.part("Also find", this.margins(), this.note("margins")),
      element(
        "details",
        {},
        element("summary", {}, "How files are read, and how exactly worlds are simulated"),
        this.choice("unit", "Lengths without a unit", [
          { value: "", label: "as the file tells, else cm" },
          ...["mm", "cm", "m", "in"].map((unit) => ({ value: unit, label: unit })),
        ]),
        this.choice("format", "Axes of tables", [
          { value: "", label: "x length, y width, z height" },
          ...catalogue.formats.map(({ name, what }) => ({ value: name, label: `${name}: ${what}` })),
        ]),
        this.text("axes", "Other axes"),
        this.choice("accuracy", "Accuracy", [
          { value: "", label: "standard" },
          { value: "screening", label: "screening: faster" },
          { value: "reference", label: "reference: slower" },
        ]),
      ),
    );
    this.node = element(
      "main",
      { class: "setup" },
      element(
        "div",
        { class: "work" },
        element(
          "div",
          { class: "tools" },
          element("h1", {}, "What is loaded"),
          element("span", { class: "gap" }),
          element("button", { onclick: choose }, "Add files…"),
        ),
        this.loads,
      ),
      element("aside", {}, this.form, element("div", { class: "go" }, this.problem, this.screen)),
    );
    setup.listen(() => this.show());
    this.show();
  }

  focus(): void {
    this.screen.focus({ preventScroll: true });
  }

  private part(title: string, ...children: (HTMLElement | null)[]): HTMLElement {
    return element("fieldset", {}, element("legend", {}, title), ...children);
  }

  private note(key: string): HTMLElement {
    const node = element("p", { class: "faint" });
    this.notes.set(key, node);
    return node;
  }

  private choice(key: Key, label: string, options: readonly { value: string; label: string }[]): HTMLElement {
    const select = element(
      "select",
      { onchange: () => this.setup.change({ [key]: select.value }) },
      ...options.map((option) => element("option", { value: option.value }, option.label)),
    );
    this.fields.set(key, select);
    return element("label", {}, element("span", {}, label), select);
  }

  private text(key: Key, label: string, attributes: Record<string, string> = {}): HTMLElement {
    const input = element("input", {
      type: "text",
      autocomplete: "off",
      ...attributes,
      oninput: () => this.setup.change({ [key]: input.value }),
    });
    this.fields.set(key, input);
    return element("label", {}, element("span", {}, label), input);
  }

  private number(key: Key, label: string): HTMLElement {
    return this.text(key, label, { inputmode: "decimal" });
  }

  private margins(): HTMLElement {
    const box = element("input", {
      type: "checkbox",
      onchange: () => this.setup.change({ margins: box.checked }),
    });
    box.checked = this.setup.choices.margins;
    return element("label", { class: "check" }, box, element("span", {}, "Margins: how many g each load stands"));
  }

  /** Shows choices, loads and what is wrong with either. */
  private show(): void {
    const { choices, facts, problem, readings, busy, usable } = this.setup;
    for (const [key, field] of this.fields) if (field.value !== choices[key]) field.value = choices[key];
    this.normSize.hidden = !takesSize(choices.norm);
    this.own.hidden = choices.container !== OWN_SIZE;
    this.problem.textContent = problem;
    this.problem.hidden = problem === "";
    if (facts) this.showFacts();
    this.screen.disabled = busy || facts === null || usable === 0;
    this.screen.textContent = usable === 0 && !busy ? "No load can be screened" : `Screen ${plural(usable, "load")}`;
    this.node.toggleAttribute("aria-busy", busy);
    this.loads.replaceChildren(...readings.map((reading) => this.file(reading)));
  }

  private showFacts(): void {
    const { facts, loads } = this.setup;
    if (!facts) return;
    const own = loads.filter(({ load }) => load.container !== undefined).length;
    const without = loads.length - own;
    const type = facts.container.type ? `${facts.container.type}, ` : "";
    const container = `${type}${sizeText(facts.container)}`;
    const noteOf = (key: string, text: string) => {
      const node = this.notes.get(key)!;
      node.textContent = text;
      node.hidden = text === "";
    };
    noteOf("norm", facts.norm ? `Source: ${facts.norm.source}` : "");
    noteOf(
      "container",
      own === 0
        ? `All loads stand in ${container}.`
        : without === 0
          ? "Each load says its own."
          : `${plural(own, "load")} say their own; the other ${without} stand in ${container}.`,
    );
    const needed = facts.norm?.neededMargins ?? [0, 0, 0, 0];
    noteOf(
      "margins",
      `Needed: ${["front", "rear", "left", "right"].map((name, i) => `${name} ${needed[i]} g`).join(", ")}`,
    );
    const { move, drop, tilt } = facts.limits;
    const limits = { move: 100 * move, drop: 100 * drop, tilt };
    for (const [key, limit] of Object.entries(limits))
      (this.fields.get(key as Key) as HTMLInputElement).placeholder = String(Number(limit.toPrecision(6)));
  }

  private file({ name, book, found, error, puzzle, own }: Reading): HTMLElement {
    const of: Of = { name, isSheet: book !== null };
    const remove = element(
      "button",
      {
        class: "plain",
        title: `Leave out ${name}`,
        "aria-label": `Leave out ${name}`,
        onclick: () => this.setup.remove(name),
      },
      "×",
    );
    const boxes = found?.loads.reduce((sum, load) => sum + load.boxCount, 0) ?? 0;
    const facts =
      found && found.errors.length === 0
        ? `${book === null ? found.form : "spreadsheet"}, ${plural(found.loads.length, "load")}, ${plural(boxes, "box")}`
        : "cannot be read";
    return element(
      "article",
      { class: "file" },
      element(
        "header",
        {},
        element("h2", { class: "name" }, name),
        element("span", { class: "faint" }, facts),
        element("span", { class: "gap" }),
        remove,
      ),
      ...(error ? [element("p", { class: "problem" }, error)] : []),
      ...(Object.keys(own).length > 0 ? [this.said(name, own)] : []),
      ...this.messages(found?.errors ?? [], "problem", of),
      ...(puzzle ? [this.puzzle(puzzle)] : []),
      ...this.messages(found?.notes ?? [], "notable", of),
      ...(found && found.loads.length > 0 ? [this.table(found.loads, of)] : []),
    );
  }

  /** What was said of a file alone, and how to take it back. */
  private said(name: string, own: FileChoices): HTMLElement {
    return element(
      "p",
      { class: "notable" },
      `As you said: ${fileChoicesText(own)}. `,
      element(
        "button",
        { class: "advice", type: "button", onclick: () => this.setup.changeFile(name, null) },
        "Take back",
      ),
    );
  }

  /** Asks what the columns of a table mean; once that is known, what was said. */
  private puzzle({ header, rows, words, solved }: Puzzle): HTMLElement {
    const explain = (next: readonly string[]) => this.setup.explain(header, next);
    const key = JSON.stringify(header);
    const open = (isOpen: boolean) => {
      if (isOpen) this.explained.add(key);
      else this.explained.delete(key);
      this.show();
    };
    if (solved && !this.explained.has(key))
      return element(
        "p",
        { class: "notable" },
        `Columns as you said: ${columnsOption(header, words)}. `,
        element("button", { class: "advice", type: "button", onclick: () => open(true) }, "Change"),
      );
    // Columns that are only useful can be said too, once those that are needed are.
    this.explained.add(key);
    const choose = (column: number) => {
      const select = element(
        "select",
        {
          "aria-label": `What ${header[column]} means`,
          onchange: () => explain(header.map((_, i) => (i === column ? select.value : words[i]))),
        },
        ...MEANINGS.map(([word, label]) => element("option", { value: word }, label)),
      );
      select.value = words[column];
      return element("td", {}, select);
    };
    return element(
      "div",
      { class: "puzzle" },
      element(
        "p",
        {},
        "Say what the columns mean that are not understood. It is remembered for tables with this header.",
      ),
      element(
        "table",
        {},
        element("thead", {}, element("tr", {}, ...header.map((name) => element("th", { scope: "col" }, name)))),
        element(
          "tbody",
          {},
          element("tr", {}, ...header.map((_, column) => choose(column))),
          ...rows.map((row) => element("tr", {}, ...row.map((cell) => element("td", {}, cell)))),
        ),
      ),
      solved ? element("button", { class: "advice", type: "button", onclick: () => open(false) }, "Done") : null,
    );
  }

  private table(loads: readonly ReadLoad[], of: Of): HTMLElement {
    return element(
      "table",
      { class: "listed" },
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          ...["Load", "Boxes", "kg", "Container"].map((title) => element("th", { scope: "col" }, title)),
        ),
      ),
      element("tbody", {}, ...loads.flatMap((load) => this.row(load, of))),
    );
  }

  private row(read: ReadLoad, of: Of): HTMLElement[] {
    const { name, load, boxCount, mass, errors, warnings } = read;
    const container = load.container ? load.container.type || sizeText(load.container) : "";
    const row = element(
      "tr",
      { class: errors.length > 0 ? "bad" : undefined },
      element("td", {}, name),
      element("td", { class: "value" }, count(boxCount)),
      element("td", { class: "value" }, mass > 0 ? count(Math.round(mass)) : ""),
      element("td", {}, container),
    );
    const messages = [...this.messages(errors, "problem", of), ...this.messages(warnings, "notable", of)];
    if (messages.length === 0) return [row];
    return [row, element("tr", { class: "said" }, element("td", { colspan: 4 }, ...messages))];
  }

  /** What is said, with buttons for what would help. */
  private messages(problems: readonly Problem[], kind: "problem" | "notable", of: Of): HTMLElement[] {
    const shown = problems.slice(0, MOST_MESSAGES).map((problem) => {
      const advices = advicesOf(problem.accepted);
      const text = messageText(problem, of.isSheet);
      if (advices.length === 0) return element("p", { class: kind }, text);
      // The buttons stand for the options of the program.
      const rest = `; ${problem.accepted}`;
      return element(
        "p",
        { class: kind },
        text.endsWith(rest) ? `${text.slice(0, -rest.length)}. ` : text,
        ...advices.map(({ text: said, change }) =>
          element(
            "button",
            { class: "advice", type: "button", onclick: () => this.setup.changeFile(of.name, change) },
            said,
          ),
        ),
      );
    });
    const more = problems.length - shown.length;
    return more > 0 ? [...shown, element("p", { class: "faint" }, `and ${more} more`)] : shown;
  }
}

/** A message without the name of the file, which stands above it. Of a sheet the row is told: it has no columns of letters. */
function messageText({ message, file, line, column }: Problem, isSheet: boolean): string {
  const place = line > 0 ? `:${line}${column > 0 ? `:${column}` : ""}` : "";
  const head = `${file}${place}: `;
  const text = message.startsWith(head) ? message.slice(head.length) : message;
  if (line === 0) return text;
  if (isSheet) return `Row ${line}: ${text}`;
  return `Line ${line}${column > 0 ? `, column ${column}` : ""}: ${text}`;
}
