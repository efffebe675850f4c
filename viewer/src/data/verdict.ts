import { VERDICT_CODES, type VerdictName } from "./outcome";

/** How the page shows a verdict. The glyph tells it from others without colour. */
export interface Verdict {
  name: string;
  glyph: string;
  /** Greater is worse; what is not known comes last. */
  badness: number;
  /** The layout does not hold: what a planner looks for. */
  fails: boolean;
  meaning: string;
}

const SHOWN: Record<VerdictName, Omit<Verdict, "name">> = {
  stayed: { glyph: "", badness: 1, fails: false, meaning: "No box moved, tilted or fell beyond the limits." },
  moved: { glyph: "–", badness: 3, fails: true, meaning: "A box was displaced or tilted beyond the limits." },
  fell: { glyph: "↓", badness: 5, fails: true, meaning: "A centre of mass sank by more than the limit." },
  unstable: {
    glyph: "!",
    badness: 6,
    fails: true,
    meaning: "A box fell or moved under gravity alone, before any acceleration.",
  },
  failed: {
    glyph: "×",
    badness: 2,
    fails: false,
    meaning: "The world could not be simulated, or its numbers cannot be trusted.",
  },
  gave_way: {
    glyph: "/",
    badness: 4,
    fails: true,
    meaning: "A box went beyond a limit, and the simulation ended there.",
  },
  not_needed: {
    glyph: "·",
    badness: 0,
    fails: false,
    meaning: "Not simulated: the layout fails another acceleration.",
  },
};

/** Verdicts by their code in the file. */
export const VERDICTS: readonly Verdict[] = Object.entries(VERDICT_CODES).reduce<Verdict[]>((all, [name, code]) => {
  all[code] = { name: name.replaceAll("_", " "), ...SHOWN[name as VerdictName] };
  return all;
}, []);

export const failing = (verdict: number) => VERDICTS[verdict]?.fails ?? false;
