import type { Results } from "../data/results";
import { choice, element } from "../ui/dom";

/** Chooses the world that is compared: another layout, another acceleration, or the same of another file. */
export function otherWorld(
  results: Results,
  world: number,
  choose: (world: number) => void,
  openFile: () => void,
  close: () => void,
): HTMLElement {
  const { worlds, layouts, accelerations } = results;
  const find = (layout: number, acceleration: number) =>
    worlds.layout.findIndex((of, index) => of === layout && worlds.acceleration[index] === acceleration);
  const layout = worlds.layout[world];
  const acceleration = worlds.acceleration[world];
  const layoutInput = element("input", {
    list: "layouts",
    value: layouts[layout],
    "aria-label": "Layout to compare with",
    onchange: () => {
      const next = find(layouts.indexOf(layoutInput.value), acceleration);
      if (next >= 0) choose(next);
      else layoutInput.value = layouts[layout];
    },
    // The list shows what contains the text: from an empty field, everything.
    onfocus: () => layoutInput.select(),
  });
  return element(
    "div",
    { class: "other" },
    layoutInput,
    element("datalist", { id: "layouts" }, ...layouts.slice(0, 500).map((name) => element("option", { value: name }))),
    choice(
      "under",
      accelerations.map((name, index) => ({ value: String(index), label: name })),
      String(acceleration),
      (next) => {
        const index = find(layout, Number(next));
        if (index >= 0) choose(index);
      },
    ).node,
    element(
      "button",
      { class: "plain", title: "Compare with the same world of another file", onclick: openFile },
      "file…",
    ),
    element(
      "button",
      { class: "plain", title: "Compare no longer (X)", "aria-label": "Compare no longer", onclick: close },
      "×",
    ),
  );
}

/** The world to begin a comparison with: the same layout under the next acceleration, or else the next layout. */
export function firstOther(results: Results, world: number): number {
  const { worlds } = results;
  const count = worlds.layout.length;
  for (let step = 1; step < count; ++step) {
    const next = (world + step) % count;
    if (worlds.layout[next] === worlds.layout[world]) return next;
  }
  return (world + 1) % count;
}

/** The world of another file with the same layout and acceleration, by name; -1: it has none. */
export function sameWorld(results: Results, layout: string, acceleration: string): number {
  const { worlds, layouts, accelerations } = results;
  const l = layouts.indexOf(layout);
  const a = accelerations.indexOf(acceleration);
  return worlds.layout.findIndex((of, index) => of === l && worlds.acceleration[index] === a);
}
