import { bytesOfResults } from "../data/write_client";
import type { Screening } from "../screen/screening";
import { choice, download, element } from "../ui/dom";
import { resultsContents } from "./results_contents";
import { type Screened, wholeLoads } from "./screened";
import { boxesCsv, marginsCsv, worldsCsv } from "./tables";

const table = (text: string) => new Blob([text], { type: "text/csv" });

/** What is saved: the ending of its name, and what is in it. */
const KINDS = {
  results: {
    label: "results file",
    ending: ".h5",
    content: async (screened: Screened) =>
      new Blob([await bytesOfResults(await resultsContents(screened))], { type: "application/x-hdf5" }),
  },
  worlds: { label: "CSV of worlds", ending: "-worlds.csv", content: async (of: Screened) => table(worldsCsv(of)) },
  boxes: { label: "CSV of boxes", ending: "-boxes.csv", content: async (of: Screened) => table(boxesCsv(of)) },
  margins: { label: "CSV of margins", ending: "-margins.csv", content: async (of: Screened) => table(marginsCsv(of)) },
};
type Kind = keyof typeof KINDS;

/** Gives the user a file with the results of a screening. */
export class SaveResults {
  readonly node: HTMLElement;
  private readonly button: HTMLButtonElement;
  private kind: Kind = "results";

  /** @param say tells why nothing is saved; an empty text: there is nothing to tell */
  constructor(
    private readonly screening: Screening,
    private readonly say: (problem: string) => void,
  ) {
    this.button = element(
      "button",
      {
        onclick: () => this.save(),
        title: "All loads of the screening; the program and this page open a results file",
      },
      "Save results",
    );
    const kinds = Object.entries(KINDS).map(([value, { label }]) => ({ value: value as Kind, label }));
    const as = choice<Kind>("as", kinds, this.kind, (kind) => {
      this.kind = kind;
    });
    this.node = element("span", { class: "save" }, this.button, as.node);
  }

  set disabled(isDisabled: boolean) {
    this.button.disabled = isDisabled;
  }

  private async save(): Promise<void> {
    const { ending, content } = KINDS[this.kind];
    this.say("");
    this.disabled = true;
    try {
      const screened = await this.screening.screened();
      if (wholeLoads(screened).length === 0) throw new Error("No load is simulated under all accelerations yet.");
      const name = screened.results.name.replace(/\.\w+$/, "");
      download(`${name}${ending}`, await content(screened));
    } catch (error) {
      this.say((error as Error).message);
    } finally {
      this.disabled = false;
    }
  }
}
