import type { LoadBox } from "holdfast-engine";
import { withPoint } from "../screen/run_choices";
import { element } from "../ui/dom";

/** What is typed of a box. */
type Said = Pick<LoadBox, "name" | "mass" | "material">;

/** The material of a box whose material nobody says, as the program takes it. */
const NO_MATERIAL = 1;

/** Fields for what a load says of a box, as a form; what cannot be used is an error with a sentence. */
export class BoxForm {
  readonly node: HTMLFormElement;
  private readonly fields = new Map<string, HTMLInputElement>();

  /**
   * @param title     what the form is called
   * @param said      of the box, to begin with
   * @param weighs    kg, without a mass of its own; null: it has to have one
   * @param withSize  also asks for its size
   * @param materials identifier of the list of those to choose from
   * @param done      the word of the button, and what it does
   */
  constructor(
    title: string,
    said: Partial<Said>,
    private readonly weighs: number | null,
    private readonly withSize: boolean,
    materials: string,
    done: { word: string; act: () => void },
  ) {
    const { name = "", mass, material } = said;
    this.node = element(
      "form",
      {
        "aria-label": title,
        onsubmit: (event: Event) => {
          event.preventDefault();
          done.act();
        },
      },
      this.field("Name", name),
      ...(withSize ? ["Length", "Width", "Height"].map((side) => this.number(`${side}, cm`, "")) : []),
      this.number(
        "Mass, kg",
        mass === undefined ? "" : String(mass),
        weighs === null ? "" : String(Number(weighs.toPrecision(6))),
      ),
      this.field("Material", material === undefined ? "" : String(material), {
        list: materials,
        placeholder: String(NO_MATERIAL),
      }),
      element("button", { type: "submit" }, done.word),
    );
  }

  /** What is said of the box. */
  said(): Said {
    const name = this.text("Name");
    const material = this.text("Material");
    const mass = this.text("Mass, kg") === "" && this.weighs !== null ? undefined : this.positive("Mass, kg");
    const number = Number(material);
    return {
      name: name === "" ? undefined : name,
      mass,
      material: material === "" ? NO_MATERIAL : Number.isInteger(number) ? number : material,
    };
  }

  /** Length, width and height, m. */
  size(): number[] {
    return this.withSize ? ["Length", "Width", "Height"].map((side) => this.positive(`${side}, cm`) / 100) : [];
  }

  private field(label: string, value: string, more: Record<string, string> = {}): HTMLElement {
    const input = element("input", { type: "text", autocomplete: "off", ...more });
    input.value = value;
    this.fields.set(label, input);
    return element("label", {}, element("span", {}, label), input);
  }

  private number(label: string, value: string, placeholder = ""): HTMLElement {
    return this.field(label, value, { inputmode: "decimal", placeholder });
  }

  private text(label: string): string {
    return this.fields.get(label)!.value.trim();
  }

  private positive(label: string): number {
    const text = this.text(label);
    const value = Number(withPoint(text));
    if (text !== "" && value > 0 && Number.isFinite(value)) return value;
    const [what, unit] = label.split(", ");
    throw new Error(
      `The ${what.toLowerCase()} has to be a number of ${unit} above 0${text === "" ? "." : `: ${text}.`}`,
    );
  }
}
