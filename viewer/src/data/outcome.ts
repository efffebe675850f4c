// Written by tools/outcome_types.py from include/holdfast/outcome_fields.h.

/** What became of a world as a whole: the worst that ever happened in it. docs/guide/verdicts.md */
export const VERDICT_CODES = {
  /** no box was ever beyond a limit */
  stayed: 0,
  /** a box was displaced or tilted beyond its limit at some time, and none fell */
  moved: 1,
  /** a box was lower than before by more than DropThreshold at some time */
  fell: 2,
  /** a box was beyond a limit while the load settled under gravity alone; it was not accelerated */
  unstable: 3,
  /** the status is not 0 and no box was beyond a limit before, or the world was cancelled: nothing can be said */
  failed: 4,
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
  /** a box was beyond a limit, with StopWhen or while the load settled: the verdict is at least what it says */
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

/** Bits of what a reader has to know beside the verdict, which they do not change. */
export const CAVEAT_BITS = {
  /** the load was still moving after SettleSeconds, when the acceleration began */
  not_at_rest: 1,
  /** a box was still moving when the world ended */
  still_moving: 2,
  /** a friction coefficient is within 2 % of what the acceleration asks for: what is not known so exactly decides */
  marginal: 4,
} as const;
export type CaveatName = keyof typeof CAVEAT_BITS;

/** What the replicas of a world say of it: docs/guide/confidence.md. */
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
   * the worst that ever happened: 0 stayed, 1 moved, 2 fell, 3 unstable (while settling, before any acceleration), 4
   * failed, 6 not_needed (left out by FirstFailure)
   */
  verdict: VerdictName;
  /** what went wrong, one bit per cause; 0: nothing; the bits are listed in docs/reference/results_file.md */
  status: number;
  /**
   * end of the last step before the first bit of the status was set: peaks are up to here, s; NaN where the status is
   * 0, or nothing was simulated
   */
  statusTime: number;
  /**
   * what has to be known beside the verdict, one bit each; 0: nothing; the bits are listed in
   * docs/reference/results_file.md
   */
  caveats: number;
  /**
   * why the world ended: 0 not run, 1 timeout, 2 sleeping, 3 failed, 4 decided (a box was beyond a limit, with StopWhen
   * or while settling)
   */
  stopReason: StopReasonName;
  /** boxes of the world, with those that are fixed to the container; 0 when it was not run */
  boxes: number;
  /** boxes that were ever lowered by more than DropThreshold */
  fallen: number;
  /** boxes that were beyond a limit while settling, before any acceleration */
  unstable: number;
  /** boxes that were ever displaced by more than MoveThreshold */
  moved: number;
  /** boxes that were ever rotated by more than TiltThreshold */
  tilted: number;
  /** boxes that are lower by more than DropThreshold at the end */
  fallenAtEnd: number;
  /**
   * box that was beyond a limit first, or, where none was, came nearest to one: position in the layout, from 1; 0 where
   * no box used up a hundredth of a limit
   */
  criticalBox: number;
  /** largest displacement of a box, over all steps, m */
  peakDisplacement: number;
  /** by how much a box was lowered at most, over all steps, m */
  peakDrop: number;
  /** largest angle of rotation of a box, over all steps, degree */
  peakTilt: number;
  /** largest displacement of a box at the end, m */
  endDisplacement: number;
  /** largest kinetic energy of all boxes together, over all steps, J */
  peakKineticEnergy: number;
  /** kinetic energy of all boxes together at the end, J */
  endKineticEnergy: number;
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

/** A field of an outcome: its dataset of the results file, and its heading in tables; empty: it has none. */
export interface OutcomeField {
  name: string;
  type: string;
  dataset: string;
  label: string;
}

/** All that the results file has of a world, in the order of tables. */
export const WORLD_FIELDS: readonly OutcomeField[] = [
  { name: "layout", type: "u64", dataset: "/worlds/layout", label: "" },
  { name: "acceleration", type: "u64", dataset: "/worlds/acceleration", label: "" },
  { name: "verdict", type: "verdict", dataset: "/summary/worlds/verdict", label: "verdict" },
  { name: "status", type: "status", dataset: "/worlds/status", label: "status" },
  { name: "message", type: "text", dataset: "/worlds/status_text", label: "status_text" },
  { name: "statusTime", type: "time", dataset: "/worlds/status_time", label: "status_time_s" },
  { name: "caveats", type: "caveat", dataset: "/worlds/caveats", label: "caveats" },
  { name: "stopReason", type: "stop_reason", dataset: "/worlds/stop_reason", label: "stop_reason" },
  { name: "boxBegin", type: "u64", dataset: "/worlds/box_begin", label: "" },
  { name: "boxes", type: "u32", dataset: "/worlds/box_count", label: "boxes" },
  { name: "sampleBegin", type: "u64", dataset: "/worlds/sample_begin", label: "" },
  { name: "sampleCount", type: "u32", dataset: "/worlds/sample_count", label: "" },
  { name: "rowBegin", type: "u64", dataset: "/worlds/row_begin", label: "" },
  { name: "fallen", type: "u32", dataset: "/summary/worlds/fallen_boxes", label: "fallen_boxes" },
  { name: "unstable", type: "u32", dataset: "/summary/worlds/unstable_boxes", label: "unstable_boxes" },
  { name: "moved", type: "u32", dataset: "/summary/worlds/moved_boxes", label: "moved_boxes" },
  { name: "tilted", type: "u32", dataset: "/summary/worlds/tilted_boxes", label: "tilted_boxes" },
  { name: "fallenAtEnd", type: "u32", dataset: "/summary/worlds/fallen_at_end", label: "fallen_at_end" },
  { name: "criticalBox", type: "u32", dataset: "/summary/worlds/critical_box", label: "critical_box" },
  { name: "peakDisplacement", type: "f32", dataset: "/summary/worlds/peak_displacement", label: "peak_displacement_m" },
  { name: "peakDrop", type: "f32", dataset: "/summary/worlds/peak_drop", label: "peak_drop_m" },
  { name: "peakTilt", type: "f32", dataset: "/summary/worlds/peak_tilt", label: "peak_tilt_deg" },
  { name: "endDisplacement", type: "f32", dataset: "/summary/worlds/end_displacement", label: "end_displacement_m" },
  {
    name: "peakKineticEnergy",
    type: "f64",
    dataset: "/summary/worlds/peak_kinetic_energy",
    label: "peak_kinetic_energy_J",
  },
  {
    name: "endKineticEnergy",
    type: "f64",
    dataset: "/summary/worlds/end_kinetic_energy",
    label: "end_kinetic_energy_J",
  },
  { name: "endTime", type: "f64", dataset: "/worlds/end_time", label: "end_time_s" },
  { name: "steps", type: "u64", dataset: "/worlds/steps", label: "steps" },
  { name: "stepsSkipped", type: "u64", dataset: "/worlds/steps_skipped", label: "steps_skipped" },
  { name: "solveIterations", type: "u64", dataset: "/worlds/solve_iterations", label: "" },
  { name: "maxResidual", type: "f64", dataset: "/worlds/max_residual", label: "max_residual" },
  { name: "residualScale", type: "f64", dataset: "/worlds/residual_scale", label: "residual_scale" },
  { name: "maxPenetration", type: "f64", dataset: "/worlds/max_penetration", label: "max_penetration_m" },
  { name: "peakTotalKineticEnergy", type: "f64", dataset: "/worlds/peak_total_kinetic_energy", label: "" },
  { name: "cpuSeconds", type: "f64", dataset: "/worlds/cpu_seconds", label: "cpu_seconds" },
  { name: "stateHash", type: "hash", dataset: "/worlds/state_hash", label: "state_hash" },
  { name: "engine", type: "text", dataset: "/worlds/engine", label: "" },
];

/** All that it has of what a box did. */
export const BOX_FIELDS: readonly OutcomeField[] = [
  { name: "peakDisplacement", type: "f32", dataset: "/boxes/peak_displacement", label: "peak_displacement_m" },
  { name: "peakDrop", type: "f32", dataset: "/boxes/peak_drop", label: "peak_drop_m" },
  { name: "peakTilt", type: "f32", dataset: "/boxes/peak_tilt", label: "peak_tilt_deg" },
  { name: "peakKineticEnergy", type: "f32", dataset: "/boxes/peak_kinetic_energy", label: "peak_kinetic_energy_J" },
  { name: "peakSpeed", type: "f32", dataset: "/boxes/peak_speed", label: "peak_speed_m_s" },
  { name: "endDisplacement", type: "vec3", dataset: "/boxes/end_displacement", label: "end_displacement_m" },
  { name: "endTilt", type: "f32", dataset: "/boxes/end_tilt", label: "end_tilt_deg" },
  { name: "endKineticEnergy", type: "f32", dataset: "/boxes/end_kinetic_energy", label: "end_kinetic_energy_J" },
  { name: "settlingDisplacement", type: "vec3", dataset: "/boxes/settling_displacement", label: "" },
  {
    name: "settlingPeakDisplacement",
    type: "f32",
    dataset: "/boxes/settling_peak_displacement",
    label: "settling_peak_displacement_m",
  },
  { name: "settlingPeakDrop", type: "f32", dataset: "/boxes/settling_peak_drop", label: "settling_peak_drop_m" },
  { name: "settlingPeakTilt", type: "f32", dataset: "/boxes/settling_peak_tilt", label: "settling_peak_tilt_deg" },
  { name: "firstBeyond", type: "f32", dataset: "/boxes/first_beyond", label: "" },
];

/** How a box is judged by the limits. */
export const BOX_VERDICT_FIELDS: readonly OutcomeField[] = [
  { name: "fallen", type: "flag", dataset: "/summary/boxes/fallen", label: "fallen" },
  { name: "moved", type: "flag", dataset: "/summary/boxes/moved", label: "moved" },
  { name: "tilted", type: "flag", dataset: "/summary/boxes/tilted", label: "tilted" },
  { name: "unstable", type: "flag", dataset: "/summary/boxes/unstable", label: "unstable" },
  { name: "fallenAtEnd", type: "flag", dataset: "/summary/boxes/fallen_at_end", label: "fallen_at_end" },
  { name: "firstBeyond", type: "f32", dataset: "/summary/boxes/first_beyond", label: "first_beyond_s" },
];
