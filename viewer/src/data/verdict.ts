/** Verdicts by their code in the file. The glyph tells them apart without colour. */
export interface Verdict {
  name: string;
  glyph: string;
  /** Greater is worse; what is not known comes last. */
  badness: number;
  meaning: string;
}

export const VERDICTS: readonly Verdict[] = [
  { name: "stayed", glyph: "", badness: 1, meaning: "No box moved, tilted or fell beyond the limits." },
  { name: "moved", glyph: "–", badness: 3, meaning: "A box was displaced or tilted beyond the limits." },
  { name: "fell", glyph: "↓", badness: 5, meaning: "A centre of mass sank by more than the limit." },
  {
    name: "unstable",
    glyph: "!",
    badness: 6,
    meaning: "A box fell or moved under gravity alone, before any acceleration.",
  },
  {
    name: "failed",
    glyph: "×",
    badness: 2,
    meaning: "The world could not be simulated, or its numbers cannot be trusted.",
  },
  { name: "gave way", glyph: "/", badness: 4, meaning: "A box went beyond a limit, and the simulation ended there." },
  { name: "not needed", glyph: "·", badness: 0, meaning: "Not simulated: the layout fails another acceleration." },
];

/** The layout does not hold: what a planner looks for. */
export const failing = (verdict: number) => verdict === 1 || verdict === 2 || verdict === 3 || verdict === 5;
