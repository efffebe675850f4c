/** Bits of /worlds/status: what went wrong, and what to do about it. */
const BITS: readonly { bit: number; name: string; meaning: string; cure: string }[] = [
  {
    bit: 1,
    name: "bad layout",
    meaning: "The layout could not be used; it was not simulated.",
    cure: "Mend the layout file.",
  },
  {
    bit: 2,
    name: "bad acceleration",
    meaning: "The acceleration could not be used; the world was not simulated.",
    cure: "Mend the acceleration file.",
  },
  {
    bit: 4,
    name: "not finite",
    meaning: "A state became infinite or NaN; the samples end before that.",
    cure: "Use a smaller step: --accuracy reference.",
  },
  {
    bit: 8,
    name: "not converged",
    meaning: "The solver's residual stayed above its limit.",
    cure: "Allow more iterations or accuracy: --accuracy reference.",
  },
  {
    bit: 16,
    name: "capacity",
    meaning: "A device had too little memory for all contacts, or failed.",
    cure: "Use another engine: --engine native.",
  },
  {
    bit: 32,
    name: "too large",
    meaning: "The series would take more than 20 million rows; the world was not simulated.",
    cure: "Use a longer ResultsIntervallInSeconds, or --no-series.",
  },
  {
    bit: 64,
    name: "not needed",
    meaning: "The layout does not hold another acceleration; this one was left out.",
    cure: "Run without --first-failure to simulate it.",
  },
];

export const causes = (status: number) => BITS.filter(({ bit }) => (status & bit) !== 0);
