// Written by tools/outcome_types.py from include/holdfast/outcome_fields.h.

/** What became of a world as a whole, by the worst that happened in it. */
export const VERDICT_CODES = {
  /** no box fell, moved or tilted, nor was any unstable */
  stayed: 0,
  /** a box moved or tilted at the end, and none fell */
  moved: 1,
  /** a box had fallen at the end */
  fell: 2,
  /** a box fell or moved while settling, before any acceleration, and no box did later */
  unstable: 3,
  /** the status is not 0, or the world was cancelled: nothing can be said */
  failed: 4,
  /** with StopWhen: a box was beyond a threshold, and the world ended there */
  gave_way: 5,
  /** with FirstFailure: the layout failed another acceleration; not simulated */
  not_needed: 6,
} as const;
export type VerdictName = keyof typeof VERDICT_CODES;

/** Why a world ended. */
export const STOP_REASON_CODES = {
  /** it was not simulated: a bad input, or cancelled */
  not_run: 0,
  /** the simulated time was up */
  timeout: 1,
  /** all boxes had come to rest */
  sleeping: 2,
  /** the status says why */
  failed: 3,
  /** with StopWhen: a box was beyond a threshold, and the verdict is gave_way */
  decided: 4,
} as const;
export type StopReasonName = keyof typeof STOP_REASON_CODES;

/** Bits of a status: what went wrong with a world, and what to do. */
export const STATUS_BITS = {
  /** the layout could not be used; not simulated, no boxes. The message says why */
  bad_layout: 1,
  /** the acceleration could not be used; not simulated. The message says why */
  bad_acceleration: 2,
  /** a state became infinite or NaN; the samples end before that. Use a smaller step */
  non_finite: 4,
  /** the solver's residual stayed above its limit. Allow more iterations or accuracy */
  not_converged: 8,
  /** a device had too little memory for all contacts of the world, or failed. Use another engine */
  capacity: 16,
  /** the series would take too much memory, more than 20 million rows; not simulated. Use a longer interval, or none */
  too_large: 32,
  /**
   * with `FirstFailure`: the layout does not hold another acceleration, which the message names; not simulated. This is
   * no problem, and the verdict is not_needed
   */
  not_needed: 64,
} as const;
export type StatusName = keyof typeof STATUS_BITS;

/** What the replicas of a world say of it: docs/confidence.md. */
export const REPLICA_VERDICT_CODES = {
  /** there are no replicas */
  none: 0,
  /** the share that fails is surely below 1/8 */
  holds: 1,
  /** it is surely above 1/2 */
  fails: 2,
  /** neither */
  uncertain: 3,
} as const;
export type ReplicaVerdictName = keyof typeof REPLICA_VERDICT_CODES;

/** A world: one layout under one acceleration. */
export interface WorldOutcome {
  /** index of the layout: row of /inputs/layouts */
  layout: number;
  /** index of the acceleration: row of /inputs/accelerations */
  acceleration: number;
  /**
   * the worst that happened: 0 stayed, 1 moved, 2 fell, 3 unstable (before any acceleration), 4 failed, 5 gave_way
   * (ended early by StopWhen), 6 not_needed (left out by FirstFailure)
   */
  verdict: VerdictName;
  /** what went wrong, one bit per cause; 0: nothing; the bits are listed in docs/results_file.md */
  status: number;
  /** why the world ended: 0 not run, 1 timeout, 2 sleeping, 3 failed, 4 decided (by StopWhen) */
  stopReason: StopReasonName;
  /** boxes of the world; 0 when it was not run */
  boxes: number;
  /** boxes that had fallen at the end */
  fallen: number;
  /** boxes that fell or moved while settling, before any acceleration */
  unstable: number;
  /** boxes displaced by more than the move threshold at the end */
  moved: number;
  /** boxes rotated by more than the tilt threshold at the end */
  tilted: number;
  /** kinetic energy of all boxes together at the end, J */
  totalKineticEnergy: number;
  /** largest kinetic energy of all boxes together, over all steps, J */
  peakKineticEnergy: number;
  /** largest displacement of a box at the end, m */
  maxDisplacement: number;
  /** largest displacement of a box, over all steps, m */
  peakDisplacement: number;
  /** simulated time at which the world ended, s */
  endTime: number;
  /** steps that the simulated time is divided into */
  steps: number;
  /** those of them that were not computed, because all islands were in static equilibrium */
  stepsSkipped: number;
  /**
   * largest change of a contact's velocity in the last iteration of a step, in the step in which it is largest relative
   * to residual_scale, m/s
   */
  maxResidual: number;
  /**
   * velocity added in that step: the norm of g - a (native) or g (others), times the step, m/s; 0 if there is no
   * residual
   */
  residualScale: number;
  /** largest penetration of a box into another or a side, over all steps, m; 0 if the engine does not measure it */
  maxPenetration: number;
  /** processor time to build and simulate the world, s */
  cpuSeconds: number;
  /** hash of the bits of the final state: equal results have equal hashes */
  stateHash: string;
}
