import { element } from "../ui/dom";
import { VIEWS } from "./camera_rig";

/** Buttons of the directions from which the load is looked at. */
export function viewButtons(view: (index: number) => void): HTMLElement {
  return element(
    "div",
    { class: "views", role: "group", "aria-label": "Views" },
    ...VIEWS.map(({ name }, index) =>
      element("button", { class: "plain", title: `${name} (${index + 1})`, onclick: () => view(index) }, name),
    ),
  );
}
