/** Light or dark: as the system says, until the user chooses. */

const KEY = "holdfast-theme";
const listeners = new Set<() => void>();
const system = matchMedia("(prefers-color-scheme: dark)");

// A page from a disk may have no storage.
function stored(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function show(): void {
  const chosen = stored();
  document.documentElement.dataset.theme = chosen ?? (system.matches ? "dark" : "light");
  colours.clear();
  for (const listener of listeners) listener();
}

export function startTheme(): void {
  system.addEventListener("change", show);
  show();
}

export function switchTheme(): void {
  const next = isDark() ? "light" : "dark";
  try {
    localStorage.setItem(KEY, next);
  } catch {
    document.documentElement.dataset.theme = next;
  }
  show();
}

export const isDark = () => document.documentElement.dataset.theme === "dark";

/** Calls back when colours have changed, until the function returned is called. */
export function onTheme(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

const colours = new Map<string, string>();

/** A colour of the style sheet, for canvas and WebGL: `colour('ink')` is `--ink`. */
export function colour(name: string): string {
  const known = colours.get(name);
  if (known !== undefined) return known;
  const value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  colours.set(name, value);
  return value;
}

export const verdictColour = (verdict: number) => colour(`verdict-${verdict}`);
