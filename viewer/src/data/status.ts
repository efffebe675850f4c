import { CAVEAT_BITS, type CaveatName, STATUS_BITS, type StatusName } from "./outcome";

/** What went wrong with a world, and what to do about it. */
interface Cause {
  name: string;
  meaning: string;
  cure: string;
}

const CAUSES: Record<StatusName, Cause> = {
  bad_layout: {
    name: "bad layout",
    meaning: "The layout could not be used; it was not simulated.",
    cure: "Mend the layout file.",
  },
  bad_acceleration: {
    name: "bad acceleration",
    meaning: "The acceleration could not be used; the world was not simulated.",
    cure: "Mend the acceleration file.",
  },
  non_finite: {
    name: "not finite",
    meaning: "A state became infinite or NaN; the samples end before that.",
    cure: "Use a smaller step: --accuracy reference.",
  },
  not_converged: {
    name: "not converged",
    meaning: "The solver's residual stayed above its limit.",
    cure: "Allow more iterations or accuracy: --accuracy reference.",
  },
  capacity: {
    name: "capacity",
    meaning: "A device had too little memory for all contacts, or failed.",
    cure: "Use another engine: --engine native.",
  },
  too_large: {
    name: "too large",
    meaning: "The series would take more than 20 million rows; the world was not simulated.",
    cure: "Use a longer ResultsIntervallInSeconds, or --no-series.",
  },
  not_needed: {
    name: "not needed",
    meaning: "The layout does not hold another acceleration; this one was left out.",
    cure: "Run without --first-failure to simulate it.",
  },
};

/** What has to be known beside the verdict, which it does not change. */
interface Caveat {
  name: string;
  meaning: string;
}

const CAVEATS: Record<CaveatName, Caveat> = {
  not_at_rest: {
    name: "not at rest",
    meaning: "The load was still moving after SettleSeconds, when the acceleration began.",
  },
  still_moving: { name: "still moving", meaning: "A box was still moving when the world ended." },
  marginal: {
    name: "marginal",
    meaning:
      "A friction coefficient is within 2 % of what the acceleration asks for: what is not known so exactly decides.",
  },
};

/** Names of the bits that are set. */
export const namesOf = <Name extends string>(bits: Readonly<Record<Name, number>>, set: number): Name[] =>
  (Object.keys(bits) as Name[]).filter((name) => (set & bits[name]) !== 0);

/** The causes whose bits are set in /worlds/status. */
export const causes = (status: number): Cause[] => namesOf(STATUS_BITS, status).map((name) => CAUSES[name]);

/** The caveats whose bits are set in /worlds/caveats. */
export const caveatsOf = (caveats: number): Caveat[] => namesOf(CAVEAT_BITS, caveats).map((name) => CAVEATS[name]);
