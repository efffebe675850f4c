import type { Scale, Sort } from "../fleet/rows";
import type { Colouring } from "../load/colouring";

/** What the page shows. All of it is in the address, so that a view can be sent to somebody. */
export interface ViewState {
  /** null: the fleet */
  world: number | null;
  /** second world, compared with the first */
  other: number | null;
  /** name of the file that the second world is from; empty: the same */
  otherFile: string;
  /** the world runs in the engine of this page */
  live: boolean;
  /** the load is changed, where it was screened in this page */
  mend: boolean;
  /** selected box of the world, from 0 */
  box: number | null;
  /** s */
  time: number;
  sort: Sort;
  scale: Scale;
  filter: string;
  colouring: Colouring;
  ghost: boolean;
  traces: boolean;
  centre: boolean;
  /** m between neighbours' places, as a share of their distance: 0 as loaded, 1 twice as far apart */
  exploded: number;
  /** share of the length that is cut away, from the door */
  clip: number;
  /** what loads are screened with, as of `RunChoices` */
  run: string;
}

export const START: ViewState = {
  world: null,
  other: null,
  otherFile: "",
  live: false,
  mend: false,
  box: null,
  time: 0,
  sort: "worst",
  scale: "verdict",
  filter: "",
  colouring: "verdict",
  ghost: false,
  traces: false,
  centre: false,
  exploded: 0,
  clip: 0,
  run: "",
};

/** What counts from 1 in the address, as wherever it is seen, and from 0 in the page. */
const NUMBERED: readonly string[] = ["world", "other", "box"];

/** The address keeps what differs from the start. */
export function toHash(state: ViewState): string {
  const parameters = new URLSearchParams();
  for (const [key, value] of Object.entries(state)) {
    if (value === START[key as keyof ViewState] || value === null) continue;
    const number = NUMBERED.includes(key) ? Number(value) + 1 : value;
    const text = typeof number === "number" ? String(Math.round(number * 1e4) / 1e4) : String(number);
    parameters.set(key, typeof value === "boolean" ? "1" : text);
  }
  return parameters.toString();
}

export function fromHash(hash: string): ViewState {
  const parameters = new URLSearchParams(hash.replace(/^#/, ""));
  const state: Record<string, unknown> = { ...START };
  for (const [key, text] of parameters) {
    if (!(key in START)) continue;
    const start = START[key as keyof ViewState];
    if (typeof start === "boolean") state[key] = text === "1";
    else if (typeof start === "string") state[key] = text;
    else if (text !== "" && Number.isFinite(Number(text))) state[key] = Number(text);
  }
  for (const key of NUMBERED) {
    const number = state[key];
    if (number !== null) state[key] = Number.isInteger(number) && Number(number) >= 1 ? Number(number) - 1 : null;
  }
  return state as unknown as ViewState;
}

type Listener = (state: ViewState, changed: ReadonlySet<keyof ViewState>) => void;

/** The one place of what is shown: views listen and update. */
export class Store {
  state: ViewState;
  private readonly listeners = new Set<Listener>();
  private writing: ReturnType<typeof setTimeout> | undefined;

  constructor(hash: string) {
    this.state = fromHash(hash);
  }

  update(change: Partial<ViewState>): void {
    const changed = this.set(change);
    if (changed.size > 0) this.writeAddress(changed.has("world") || changed.has("other") || changed.has("live"));
  }

  /** Shows what an address says. */
  restore(hash: string): void {
    clearTimeout(this.writing);
    this.set(fromHash(hash));
  }

  private set(change: Partial<ViewState>): ReadonlySet<keyof ViewState> {
    const changed = new Set<keyof ViewState>();
    for (const key of Object.keys(change) as (keyof ViewState)[]) if (this.state[key] !== change[key]) changed.add(key);
    if (changed.size === 0) return changed;
    this.state = { ...this.state, ...change };
    for (const listener of this.listeners) listener(this.state, changed);
    return changed;
  }

  /** Calls back after each change, until the function returned is called. */
  listen(listener: Listener): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** A page that opens is a step of the history; a change within it, at most a few times a second, is none. */
  private writeAddress(step: boolean): void {
    clearTimeout(this.writing);
    const write = () => {
      const address = `#${toHash(this.state)}`;
      if (step) history.pushState(null, "", address);
      else history.replaceState(null, "", address);
    };
    if (step) write();
    else this.writing = setTimeout(write, 250);
  }
}
