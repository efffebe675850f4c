import { STOP_REASON_CODES, VERDICT_CODES, type VerdictName } from "./outcome";

/** Said of a file of an earlier version. */
export const JUDGED_AT_END =
  "This file is of an earlier version: its worlds are judged by where boxes are at the end, not by what they did on the way.";

export const NOT_MODELLED = "Straps, air bags and stretch film are not modelled.";

/** How the page shows a verdict. The glyph tells it from others without colour. */
export interface Verdict {
  name: string;
  glyph: string;
  /** Greater is worse; what is not known comes behind all that fails. */
  badness: number;
  /** The layout does not hold: what a planner looks for. */
  fails: boolean;
  meaning: string;
  /** The same in a file of an earlier version, whose worlds are judged by where boxes are at the end. */
  meaningAtEnd: string;
}

const FAILED = "The world could not be simulated, or its numbers cannot be trusted.";
const LEFT_OUT = "Not simulated: the layout fails another acceleration.";

const SHOWN: Record<VerdictName, Omit<Verdict, "name">> = {
  stayed: {
    glyph: "",
    badness: 1,
    fails: false,
    meaning: "No box was ever beyond a limit.",
    meaningAtEnd: "No box is beyond a limit at the end.",
  },
  moved: {
    glyph: "–",
    badness: 3,
    fails: true,
    meaning: "A box was displaced or tilted beyond its limit at some time, and none fell.",
    meaningAtEnd: "A box is displaced or tilted beyond its limit at the end, and none has fallen.",
  },
  fell: {
    glyph: "↓",
    badness: 4,
    fails: true,
    meaning: "A box was lower by more than the limit at some time.",
    meaningAtEnd: "A box is lower by more than the limit at the end.",
  },
  unstable: {
    glyph: "!",
    badness: 5,
    fails: true,
    meaning: "A box was beyond a limit while the load settled under gravity alone; it was not accelerated.",
    meaningAtEnd: "A box fell or moved while the load settled under gravity alone, and none did later.",
  },
  failed: { glyph: "×", badness: 2, fails: false, meaning: FAILED, meaningAtEnd: FAILED },
  not_needed: { glyph: "·", badness: 0, fails: false, meaning: LEFT_OUT, meaningAtEnd: LEFT_OUT },
};

/** Verdicts by their code in the file. */
export const VERDICTS: readonly Verdict[] = Object.entries(VERDICT_CODES).reduce<Verdict[]>((all, [name, code]) => {
  all[code] = { name: name.replaceAll("_", " "), ...SHOWN[name as VerdictName] };
  return all;
}, []);

export const failing = (verdict: number) => VERDICTS[verdict]?.fails ?? false;

/** The world ended when its verdict was decided: worse could have followed, and its counts are of that moment. */
export const isAtLeast = (verdict: number, stopReason: number) =>
  stopReason === STOP_REASON_CODES.decided && verdict !== VERDICT_CODES.unstable;

/** The name of a world's verdict. */
export const verdictText = (verdict: number, stopReason: number) =>
  `${isAtLeast(verdict, stopReason) ? "at least " : ""}${VERDICTS[verdict].name}`;

export const meaningOf = (verdict: number, judgedAtEnd: boolean) =>
  judgedAtEnd ? VERDICTS[verdict].meaningAtEnd : VERDICTS[verdict].meaning;
