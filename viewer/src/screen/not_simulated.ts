import type { WorldOutcome } from "holdfast-engine";
import { STATUS_BITS, WORLD_FIELDS } from "../data/outcome";
import { NOT_COUNTED } from "../data/results";

/** What the program says of a world whose load cannot be used: nothing is counted there, and no peak is known. */
export function notSimulated(): WorldOutcome {
  const values = WORLD_FIELDS.map(({ name, type, dataset }) => {
    const isDerived = dataset.startsWith("/summary/");
    if (type === "time") return [name, Number.NaN];
    return [name, !isDerived ? 0 : type === "u32" ? NOT_COUNTED : Number.NaN];
  });
  const known = { verdict: "failed", stopReason: "not_run", status: STATUS_BITS.bad_layout, stateHash: "0" };
  return { ...Object.fromEntries(values), ...known };
}
