type Child = Node | string | null | false | undefined;

/** An element with its attributes and children; `on...` names an event, a boolean an attribute that is there or not. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, unknown> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") node.addEventListener(name.slice(2), value as EventListener);
    else if (value === true) node.setAttribute(name, "");
    else if (value !== false && value !== undefined && value !== null) node.setAttribute(name, String(value));
  }
  node.append(
    ...children.filter((child): child is Node | string => child !== null && child !== false && child !== undefined),
  );
  return node;
}

/** A choice from a list, with its label. */
export function choice<T extends string>(
  label: string,
  options: readonly { value: T; label: string }[],
  value: T,
  change: (value: T) => void,
): { node: HTMLElement; set: (value: T) => void } {
  const select = element(
    "select",
    { "aria-label": label, onchange: () => change(select.value as T) },
    ...options.map((option) => element("option", { value: option.value }, option.label)),
  );
  select.value = value;
  return {
    node: element("label", { class: "choice" }, element("span", {}, label), select),
    set: (next) => {
      select.value = next;
    },
  };
}

/** Gives the user a file. */
export function download(name: string, content: Blob): void {
  const link = element("a", { href: URL.createObjectURL(content), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Runs once in the next frame, however often it is asked for. */
export function oncePerFrame(draw: () => void): () => void {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      draw();
    });
  };
}
