import type { Results } from "../data/results";
import { element } from "./dom";
import { bytes, plural } from "./text";
import { switchTheme } from "./theme";

/** The line at the top: where one is, and what concerns the whole page. */
export class TopBar {
  private readonly path = element("nav", { "aria-label": "Where you are" });
  private readonly notice = element("span", { class: "notice", role: "status" });
  private readonly printButton: HTMLElement;
  readonly node: HTMLElement;

  constructor(
    private readonly home: () => void,
    choose: () => void,
    help: () => void,
    print: () => void,
  ) {
    this.printButton = element(
      "button",
      { class: "plain", onclick: print, title: "A page to print for each load (Ctrl-P)" },
      "Print",
    );
    this.node = element(
      "header",
      {},
      this.path,
      this.notice,
      element("span", { class: "gap" }),
      this.printButton,
      element("button", { class: "plain", onclick: choose }, "Open…"),
      element(
        "button",
        { class: "plain", onclick: switchTheme, title: "Light or dark", "aria-label": "Light or dark" },
        "◐",
      ),
      element("button", { class: "plain", onclick: help, title: "Keys (?)", "aria-label": "Keys" }, "?"),
    );
    this.show(null, []);
  }

  show(results: Results | null, titles: string[]): void {
    const steps: (HTMLElement | string)[] = [element("span", { class: "mark" }, "holdfast")];
    if (results) {
      const file = element("button", { class: "plain", onclick: this.home, title: "All layouts (M)" }, results.name);
      steps.push(file);
      if (titles.length === 0)
        steps.push(
          element(
            "span",
            { class: "faint" },
            [plural(results.worlds.layout.length, "world"), results.size === null ? null : bytes(results.size)]
              .filter((part) => part !== null)
              .join(" · "),
          ),
        );
    }
    for (const title of titles) steps.push(element("span", { class: "crumb" }, title));
    this.path.replaceChildren(...steps);
    this.printButton.hidden = results === null;
    this.notice.textContent =
      results && !results.complete
        ? "Part of an unfinished run: it has some of its worlds. holdfast screen --resume finishes the run."
        : "";
    document.title = results ? `${titles[0] ?? results.name} – holdfast` : "holdfast";
  }

  /** What did not work, until something else is shown. */
  say(problem: string): void {
    this.notice.textContent = problem;
  }
}
