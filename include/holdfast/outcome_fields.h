#ifndef HOLDFAST_OUTCOME_FIELDS_H
#define HOLDFAST_OUTCOME_FIELDS_H

/* What an outcome consists of, one row per field and per name: the only place that spells them. The structures of
 * holdfast.h and outcomes.hpp, the datasets of the results file, JSON, CSV, the columns of the Python package and the
 * types of the page are made of these rows. To add a field is to add a row, and to set it where it is found. Part of
 * both headers, which include it. "The message" of a status is `status_text` of the results file.
 *
 * A row of a field is X(scope, type, name, dataset, label, since, unit, sentence):
 *
 *   scope     what the field is of, and where it is shown
 *               recorded  found by the simulation: structures, results file, JSON and CSV
 *               message   the same, but a function gives it in C
 *               stored    found by the simulation: results file alone
 *               derived   a judgement by the limits, or what it rests on: structures, results file, JSON and CSV
 *   type      u32, u64, f32, f64, time (f64, NaN at first), vec3 (x, y, z as f32), flag (0 or 1), hash (64 bits), text,
 *             or one of the names below
 *   name      of the member of a structure
 *   dataset   of the results file
 *   label     in JSON, and as a heading of CSV: name and unit; "": not shown there
 *   since     version of the results file that has the field first
 *   unit      "1": a number without unit; "none": no number
 *   sentence  its meaning
 *
 * A row of a name is X(name, C_NAME, code, sentence). Codes are never used again for something else. */

/* clang-format off */

/* What became of a world as a whole: the worst that ever happened in it. docs/guide/verdicts.md */
#define HOLDFAST_VERDICTS(X) \
  X(stayed,     STAYED,    0, "no box was ever beyond a limit") \
  X(moved,      MOVED,     1, "a box was displaced or tilted beyond its limit at some time, and none fell") \
  X(fell,       FELL,      2, "a box was lower than before by more than DropThreshold at some time") \
  X(unstable,   UNSTABLE,  3, "a box was beyond a limit while the load settled under gravity alone; it was not accelerated") \
  X(failed,     FAILED,    4, "the status is not 0 and no box was beyond a limit before, or the world was cancelled: nothing can be said") \
  X(not_needed, NOT_ASKED, 6, "with FirstFailure: the layout failed another acceleration; not simulated")

/* Why a world ended. */
#define HOLDFAST_STOP_REASONS(X) \
  X(not_run,  NOT_RUN,        0, "it was not simulated: a bad input, or cancelled") \
  X(timeout,  TIMEOUT,        1, "the simulated time was up") \
  X(sleeping, SLEEPING,       2, "all boxes had come to rest") \
  X(failed,   ENDED_BY_ERROR, 3, "the status says why") \
  X(decided,  DECIDED,        4, "a box was beyond a limit, with StopWhen or while the load settled: the verdict is at least what it says")

/* Bits of a status: what went wrong with a world, and what to do. */
#define HOLDFAST_STATUS_BITS(X) \
  X(bad_layout,       BAD_LAYOUT,        1, "the layout could not be used; not simulated, no boxes. The message says why") \
  X(bad_acceleration, BAD_ACCELERATION,  2, "the acceleration could not be used; not simulated. The message says why") \
  X(non_finite,       NON_FINITE,        4, "a state became infinite or NaN; the samples end before that. Use a smaller step") \
  X(not_converged,    NOT_CONVERGED,     8, "the solver's residual stayed above its limit. Allow more iterations or accuracy") \
  X(capacity,         CAPACITY,         16, "a device had too little memory for all contacts of the world, or failed. Use another engine") \
  X(too_large,        TOO_LARGE,        32, "the series would take too much memory, more than 20 million rows; not simulated. Use a longer interval, or none") \
  X(not_needed,       NOT_NEEDED,       64, "with `FirstFailure`: the layout does not hold another acceleration, which the message names; not simulated. This is no problem, and the verdict is not_needed")

/* Bits of what a reader has to know beside the verdict, which they do not change. */
#define HOLDFAST_CAVEAT_BITS(X) \
  X(not_at_rest,  NOT_AT_REST,  1, "the load was still moving after SettleSeconds, when the acceleration began") \
  X(still_moving, STILL_MOVING, 2, "a box was still moving when the world ended") \
  X(marginal,     MARGINAL,     4, "a friction coefficient is within 2 % of what the acceleration asks for: what is not known so exactly decides")

/* What the replicas of a world say of it: docs/guide/confidence.md. */
#define HOLDFAST_REPLICA_VERDICTS(X) \
  X(none,      REPLICAS_NONE,      0, "there are no replicas") \
  X(holds,     REPLICAS_HOLD,      1, "the share that fails is surely below 1/8") \
  X(fails,     REPLICAS_FAIL,      2, "it is surely above 1/2") \
  X(uncertain, REPLICAS_UNCERTAIN, 3, "neither")

/* What an engine counts and measures of a world. */
#define HOLDFAST_COUNTER_FIELDS(X) \
  X(recorded, u64, steps,            "/worlds/steps",            "steps",             1, "1", "steps that the simulated time is divided into") \
  X(recorded, u64, steps_skipped,    "/worlds/steps_skipped",    "steps_skipped",     1, "1", "those of them that were not computed, because all islands were in static equilibrium") \
  X(stored,   u64, solve_iterations, "/worlds/solve_iterations", "",                  1, "1", "iterations of the contact solver over all steps") \
  X(recorded, f64, max_residual,     "/worlds/max_residual",     "max_residual",      1, "m/s", "largest change of a contact's velocity in the last iteration of a step, in the step in which it is largest relative to residual_scale") \
  X(recorded, f64, residual_scale,   "/worlds/residual_scale",   "residual_scale",    2, "m/s", "velocity added in that step: the norm of g - a (native) or g (others), times the step; 0 if there is no residual") \
  X(recorded, f64, max_penetration,  "/worlds/max_penetration",  "max_penetration_m", 1, "m", "largest penetration of a box into another or a side, over all steps; 0 if the engine does not measure it")

/* A world: one layout under one acceleration. */
#define HOLDFAST_WORLD_FIELDS(X) \
  X(recorded, u64,         layout,       "/worlds/layout",          "",            1, "1", "index of the layout: row of /inputs/layouts") \
  X(recorded, u64,         acceleration, "/worlds/acceleration",    "",            1, "1", "index of the acceleration: row of /inputs/accelerations") \
  X(derived,  verdict,     verdict,      "/summary/worlds/verdict", "verdict",     1, "1", "the worst that ever happened: 0 stayed, 1 moved, 2 fell, 3 unstable (while settling, before any acceleration), 4 failed, 6 not_needed (left out by FirstFailure)") \
  X(recorded, status,      status,       "/worlds/status",          "status",      1, "1", "what went wrong, one bit per cause; 0: nothing; the bits are listed in docs/reference/results_file.md") \
  X(message,  text,        message,      "/worlds/status_text",     "status_text", 1, "none", "an explanation if the status is not 0") \
  X(recorded, time,        status_time,  "/worlds/status_time",     "status_time_s", 3, "s", "end of the last step before the first bit of the status was set: peaks are up to here; NaN where the status is 0, or nothing was simulated") \
  X(recorded, caveat,      caveats,      "/worlds/caveats",         "caveats",     3, "1", "what has to be known beside the verdict, one bit each; 0: nothing; the bits are listed in docs/reference/results_file.md") \
  X(recorded, stop_reason, stop_reason,  "/worlds/stop_reason",     "stop_reason", 1, "1", "why the world ended: 0 not run, 1 timeout, 2 sleeping, 3 failed, 4 decided (a box was beyond a limit, with StopWhen or while settling)") \
  X(stored,   u64,         box_begin,    "/worlds/box_begin",       "",            1, "1", "first box of the world: row of /boxes and /summary/boxes") \
  X(recorded, u32,         boxes,        "/worlds/box_count",       "boxes",       1, "1", "boxes of the world, with those that are fixed to the container; 0 when it was not run") \
  X(stored,   u64,         sample_begin, "/worlds/sample_begin",    "",            1, "1", "first sample of the world: entry of /series/time and the other datasets with one entry per sample") \
  X(stored,   u32,         sample_count, "/worlds/sample_count",    "",            1, "1", "samples of the world; 0 without series") \
  X(stored,   u64,         row_begin,    "/worlds/row_begin",       "",            1, "1", "first row of the world in /series/displacement and the other datasets with one entry per sample and box: row = row_begin + sample * box_count + box") \
  X(derived,  u32, fallen,        "/summary/worlds/fallen_boxes",   "fallen_boxes",   1, "1", "boxes that were ever lowered by more than DropThreshold") \
  X(derived,  u32, unstable,      "/summary/worlds/unstable_boxes", "unstable_boxes", 1, "1", "boxes that were beyond a limit while settling, before any acceleration") \
  X(derived,  u32, moved,         "/summary/worlds/moved_boxes",    "moved_boxes",    1, "1", "boxes that were ever displaced by more than MoveThreshold") \
  X(derived,  u32, tilted,        "/summary/worlds/tilted_boxes",   "tilted_boxes",   1, "1", "boxes that were ever rotated by more than TiltThreshold") \
  X(derived,  u32, fallen_at_end, "/summary/worlds/fallen_at_end",  "fallen_at_end",  3, "1", "boxes that are lower by more than DropThreshold at the end") \
  X(derived,  u32, critical_box,  "/summary/worlds/critical_box",   "critical_box",   3, "1", "box that was beyond a limit first, or, where none was, came nearest to one: position in the layout, from 1; 0 where no box used up a hundredth of a limit") \
  X(derived,  f32, peak_displacement, "/summary/worlds/peak_displacement", "peak_displacement_m",  1, "m", "largest displacement of a box, over all steps") \
  X(derived,  f32, peak_drop,         "/summary/worlds/peak_drop",         "peak_drop_m",          3, "m", "by how much a box was lowered at most, over all steps") \
  X(derived,  f32, peak_tilt,         "/summary/worlds/peak_tilt",         "peak_tilt_deg",        3, "degree", "largest angle of rotation of a box, over all steps") \
  X(derived,  f32, end_displacement,  "/summary/worlds/end_displacement",  "end_displacement_m",   3, "m", "largest displacement of a box at the end") \
  X(derived,  f64, peak_kinetic_energy, "/summary/worlds/peak_kinetic_energy", "peak_kinetic_energy_J", 1, "J", "largest kinetic energy of all boxes together, over all steps") \
  X(derived,  f64, end_kinetic_energy,  "/summary/worlds/end_kinetic_energy",  "end_kinetic_energy_J",  3, "J", "kinetic energy of all boxes together at the end") \
  X(recorded, f64, end_time, "/worlds/end_time", "end_time_s", 1, "s", "simulated time at which the world ended") \
  HOLDFAST_COUNTER_FIELDS(X) \
  X(stored,   f64,  peak_total_kinetic_energy, "/worlds/peak_total_kinetic_energy", "", 1, "J", "largest kinetic energy of all boxes together, over all steps") \
  X(recorded, f64,  cpu_seconds, "/worlds/cpu_seconds", "cpu_seconds", 1, "s", "processor time to build and simulate the world") \
  X(recorded, hash, state_hash,  "/worlds/state_hash",  "state_hash",  1, "1", "hash of the bits of the final state: equal results have equal hashes") \
  X(stored,   text, engine,      "/worlds/engine",      "",            1, "none", "name of the engine")

/* A box: what the simulation finds. Displacement, drop and tilt are from the reference pose: the one at t = 0, after
 * settling, or by ReferencePose that of the layout; while settling, and in a world that is unstable, that of the layout.
 * Peaks are over all steps that can be trusted: from t = 0 to the end, or to the first bit of the status; in a world that
 * is unstable, and was not accelerated, over those of settling. */
#define HOLDFAST_BOX_FIELDS(X) \
  X(recorded, f32,  peak_displacement,   "/boxes/peak_displacement",   "peak_displacement_m",   1, "m", "largest length of the displacement, over all steps") \
  X(recorded, f32,  peak_drop,           "/boxes/peak_drop",           "peak_drop_m",           3, "m", "by how much the centre of mass was lower at most, over all steps; never negative") \
  X(recorded, f32,  peak_tilt,           "/boxes/peak_tilt",           "peak_tilt_deg",         3, "degree", "largest angle of the rotation, over all steps") \
  X(recorded, f32,  peak_kinetic_energy, "/boxes/peak_kinetic_energy", "peak_kinetic_energy_J", 1, "J", "largest kinetic energy, over all steps") \
  X(recorded, f32,  peak_speed,          "/boxes/peak_speed",          "peak_speed_m_s",        3, "m/s", "largest speed of the centre of mass in the container, over all steps; NaN in a file of an earlier version") \
  X(recorded, vec3, end_displacement,    "/boxes/end_displacement",    "end_displacement_m",    1, "m", "displacement x, y, z of the centre of mass, at the end") \
  X(recorded, f32,  end_tilt,            "/boxes/end_tilt",            "end_tilt_deg",          1, "degree", "angle of the rotation, at the end") \
  X(recorded, f32,  end_kinetic_energy,  "/boxes/end_kinetic_energy",  "end_kinetic_energy_J",  1, "J", "kinetic energy in the container's frame, at the end") \
  X(stored, vec3, settling_displacement,      "/boxes/settling_displacement",      "", 1, "m", "displacement x, y, z from the layout's pose at the end of settling, before t = 0") \
  X(recorded, f32, settling_peak_displacement, "/boxes/settling_peak_displacement", "settling_peak_displacement_m", 3, "m", "largest length of the displacement while settling, before t = 0") \
  X(recorded, f32, settling_peak_drop,         "/boxes/settling_peak_drop",         "settling_peak_drop_m",         3, "m", "by how much the centre of mass was lower at most while settling") \
  X(recorded, f32, settling_peak_tilt,         "/boxes/settling_peak_tilt",         "settling_peak_tilt_deg",       3, "degree", "largest angle of the rotation while settling") \
  X(stored, f32, first_beyond,                "/boxes/first_beyond",               "", 3, "s", "end of the first step in which the box was beyond a limit of the run, negative while settling; NaN if it never was")

/* A box: the judgement by the limits. */
#define HOLDFAST_BOX_VERDICT_FIELDS(X) \
  X(derived, flag, fallen,        "/summary/boxes/fallen",        "fallen",         1, "1", "1 when peak_drop exceeds DropThreshold, else 0") \
  X(derived, flag, moved,         "/summary/boxes/moved",         "moved",          1, "1", "1 when peak_displacement exceeds MoveThreshold, else 0") \
  X(derived, flag, tilted,        "/summary/boxes/tilted",        "tilted",         1, "1", "1 when peak_tilt exceeds TiltThreshold, else 0") \
  X(derived, flag, unstable,      "/summary/boxes/unstable",      "unstable",       1, "1", "1 when a peak while settling exceeds one of the three, else 0") \
  X(derived, flag, fallen_at_end, "/summary/boxes/fallen_at_end", "fallen_at_end",  3, "1", "1 when the box is lower by more than DropThreshold at the end, else 0") \
  X(derived, f32,  first_beyond,  "/summary/boxes/first_beyond",  "first_beyond_s", 3, "s", "end of the first step in which the box was beyond a limit, negative while settling; NaN if it never was, or by other limits than those of the run")

/* clang-format on */

/* Whether a field is a member of the structures that a program gets; in C, where a function gives messages. */
#define HOLDFAST_IF_C_recorded(member) member
#define HOLDFAST_IF_C_derived(member) member
#define HOLDFAST_IF_C_message(member)
#define HOLDFAST_IF_C_stored(member)
#define HOLDFAST_IF_PUBLIC_recorded(member) member
#define HOLDFAST_IF_PUBLIC_derived(member) member
#define HOLDFAST_IF_PUBLIC_message(member) member
#define HOLDFAST_IF_PUBLIC_stored(member)

#endif /* HOLDFAST_OUTCOME_FIELDS_H */
