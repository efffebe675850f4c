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
 *               copied    the same, but CSV has its copy in /summary/boxes
 *               derived   a judgement by the thresholds, or what it rests on: as `recorded`
 *               message   the same, but a function gives it in C
 *               stored    recorded, for the results file alone
 *               summary   derived, for the results file and CSV alone
 *   type      u32, u64, f32, f64, vec3 (x, y, z as f32), flag (0 or 1), hash (64 bits), text, or one of the names below
 *   name      of the member of a structure
 *   dataset   of the results file
 *   label     in JSON, and as a heading of CSV: name and unit; "": not shown there
 *   since     version of the results file that has the field first
 *   unit      "1": a number without unit; "none": no number
 *   sentence  its meaning
 *
 * A row of a name is X(name, C_NAME, code, sentence). Codes are never used again for something else. */

/* clang-format off */

/* What became of a world as a whole, by the worst that happened in it. */
#define HOLDFAST_VERDICTS(X) \
  X(stayed,     STAYED,    0, "no box fell, moved or tilted, nor was any unstable") \
  X(moved,      MOVED,     1, "a box moved or tilted at the end, and none fell") \
  X(fell,       FELL,      2, "a box had fallen at the end") \
  X(unstable,   UNSTABLE,  3, "a box fell or moved while settling, before any acceleration, and no box did later") \
  X(failed,     FAILED,    4, "the status is not 0, or the world was cancelled: nothing can be said") \
  X(gave_way,   GAVE_WAY,  5, "with StopWhen: a box was beyond a threshold, and the world ended there") \
  X(not_needed, NOT_ASKED, 6, "with FirstFailure: the layout failed another acceleration; not simulated")

/* Why a world ended. */
#define HOLDFAST_STOP_REASONS(X) \
  X(not_run,  NOT_RUN,        0, "it was not simulated: a bad input, or cancelled") \
  X(timeout,  TIMEOUT,        1, "the simulated time was up") \
  X(sleeping, SLEEPING,       2, "all boxes had come to rest") \
  X(failed,   ENDED_BY_ERROR, 3, "the status says why") \
  X(decided,  DECIDED,        4, "with StopWhen: a box was beyond a threshold, and the verdict is gave_way")

/* Bits of a status: what went wrong with a world, and what to do. */
#define HOLDFAST_STATUS_BITS(X) \
  X(bad_layout,       BAD_LAYOUT,        1, "the layout could not be used; not simulated, no boxes. The message says why") \
  X(bad_acceleration, BAD_ACCELERATION,  2, "the acceleration could not be used; not simulated. The message says why") \
  X(non_finite,       NON_FINITE,        4, "a state became infinite or NaN; the samples end before that. Use a smaller step") \
  X(not_converged,    NOT_CONVERGED,     8, "the solver's residual stayed above its limit. Allow more iterations or accuracy") \
  X(capacity,         CAPACITY,         16, "a device had too little memory for all contacts of the world, or failed. Use another engine") \
  X(too_large,        TOO_LARGE,        32, "the series would take too much memory, more than 20 million rows; not simulated. Use a longer interval, or none") \
  X(not_needed,       NOT_NEEDED,       64, "with `FirstFailure`: the layout does not hold another acceleration, which the message names; not simulated. This is no problem, and the verdict is not_needed")

/* What the replicas of a world say of it: docs/confidence.md. */
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
  X(derived,  verdict,     verdict,      "/summary/worlds/verdict", "verdict",     1, "1", "the worst that happened: 0 stayed, 1 moved, 2 fell, 3 unstable (before any acceleration), 4 failed, 5 gave_way (ended early by StopWhen), 6 not_needed (left out by FirstFailure)") \
  X(recorded, status,      status,       "/worlds/status",          "status",      1, "1", "what went wrong, one bit per cause; 0: nothing; the bits are listed in docs/results_file.md") \
  X(message,  text,        message,      "/worlds/status_text",     "status_text", 1, "none", "an explanation if the status is not 0") \
  X(recorded, stop_reason, stop_reason,  "/worlds/stop_reason",     "stop_reason", 1, "1", "why the world ended: 0 not run, 1 timeout, 2 sleeping, 3 failed, 4 decided (by StopWhen)") \
  X(stored,   u64,         box_begin,    "/worlds/box_begin",       "",            1, "1", "first box of the world: row of /boxes and /summary/boxes") \
  X(recorded, u32,         boxes,        "/worlds/box_count",       "boxes",       1, "1", "boxes of the world; 0 when it was not run") \
  X(stored,   u64,         sample_begin, "/worlds/sample_begin",    "",            1, "1", "first sample of the world: entry of /series/time and the other datasets with one entry per sample") \
  X(stored,   u32,         sample_count, "/worlds/sample_count",    "",            1, "1", "samples of the world; 0 without series") \
  X(stored,   u64,         row_begin,    "/worlds/row_begin",       "",            1, "1", "first row of the world in /series/displacement and the other datasets with one entry per sample and box: row = row_begin + sample * box_count + box") \
  X(derived,  u32, fallen,   "/summary/worlds/fallen_boxes",   "fallen_boxes",   1, "1", "boxes that had fallen at the end") \
  X(derived,  u32, unstable, "/summary/worlds/unstable_boxes", "unstable_boxes", 1, "1", "boxes that fell or moved while settling, before any acceleration") \
  X(derived,  u32, moved,    "/summary/worlds/moved_boxes",    "moved_boxes",    1, "1", "boxes displaced by more than the move threshold at the end") \
  X(derived,  u32, tilted,   "/summary/worlds/tilted_boxes",   "tilted_boxes",   1, "1", "boxes rotated by more than the tilt threshold at the end") \
  X(derived,  f64, total_kinetic_energy, "/summary/worlds/total_kinetic_energy", "total_kinetic_energy_J", 1, "J", "kinetic energy of all boxes together at the end") \
  X(derived,  f64, peak_kinetic_energy,  "/summary/worlds/peak_kinetic_energy",  "peak_kinetic_energy_J",  1, "J", "largest kinetic energy of all boxes together, over all steps") \
  X(derived,  f32, max_displacement,     "/summary/worlds/max_displacement",     "max_displacement_m",     1, "m", "largest displacement of a box at the end") \
  X(derived,  f32, peak_displacement,    "/summary/worlds/peak_displacement",    "peak_displacement_m",    1, "m", "largest displacement of a box, over all steps") \
  X(recorded, f64, end_time, "/worlds/end_time", "end_time_s", 1, "s", "simulated time at which the world ended") \
  HOLDFAST_COUNTER_FIELDS(X) \
  X(stored,   f64,  peak_total_kinetic_energy, "/worlds/peak_total_kinetic_energy", "", 1, "J", "largest kinetic energy of all boxes together, over all steps") \
  X(recorded, f64,  cpu_seconds, "/worlds/cpu_seconds", "cpu_seconds", 1, "s", "processor time to build and simulate the world") \
  X(recorded, hash, state_hash,  "/worlds/state_hash",  "state_hash",  1, "1", "hash of the bits of the final state: equal results have equal hashes") \
  X(stored,   text, engine,      "/worlds/engine",      "",            1, "none", "name of the engine")

/* A box: what the simulation finds. The reference pose is that of the layout, or by ReferencePose the one after
 * settling. */
#define HOLDFAST_BOX_FIELDS(X) \
  X(copied, vec3, displacement,          "/boxes/end_displacement",      "displacement_m",        1, "m", "displacement x, y, z of the centre of mass from the reference pose, at the end") \
  X(copied, f32,  tilt,                  "/boxes/end_tilt",              "tilt_deg",              1, "degree", "angle of the rotation from the reference pose, at the end") \
  X(copied, f32,  kinetic_energy,        "/boxes/end_kinetic_energy",    "kinetic_energy_J",      1, "J", "kinetic energy in the container's frame, at the end") \
  X(copied, f32,  peak_displacement,     "/boxes/peak_displacement",     "peak_displacement_m",   1, "m", "largest length of the displacement, over all steps") \
  X(copied, f32,  peak_kinetic_energy,   "/boxes/peak_kinetic_energy",   "peak_kinetic_energy_J", 1, "J", "largest kinetic energy, over all steps") \
  X(recorded, f32, peak_speed,           "/boxes/peak_speed",            "peak_speed_m_s",        3, "m/s", "largest speed of the centre of mass in the container, over all steps; NaN in a file of an earlier version") \
  X(stored, vec3, settling_displacement, "/boxes/settling_displacement", "",                      1, "m", "displacement x, y, z while settling under gravity alone, before t = 0")

/* A box: the judgement by the thresholds, and what it rests on. */
#define HOLDFAST_BOX_VERDICT_FIELDS(X) \
  X(summary, vec3, displacement,        "/summary/boxes/displacement",        "displacement_m",        1, "m", "displacement x, y, z of the centre of mass at the end") \
  X(summary, f32,  max_displacement,    "/summary/boxes/max_displacement",    "max_displacement_m",    1, "m", "largest length of the displacement, over all steps") \
  X(summary, f32,  drop,                "/summary/boxes/drop",                "drop_m",                1, "m", "how much lower the centre of mass is at the end; negative: higher") \
  X(summary, f32,  tilt,                "/summary/boxes/tilt",                "tilt_degree",           1, "degree", "angle of the rotation at the end") \
  X(summary, f32,  kinetic_energy,      "/summary/boxes/kinetic_energy",      "kinetic_energy_J",      1, "J", "kinetic energy at the end") \
  X(summary, f32,  peak_kinetic_energy, "/summary/boxes/peak_kinetic_energy", "peak_kinetic_energy_J", 1, "J", "largest kinetic energy, over all steps") \
  X(derived, flag, fallen,              "/summary/boxes/fallen",              "fallen",                1, "1", "1 when drop exceeds the drop threshold, else 0") \
  X(derived, flag, moved,               "/summary/boxes/moved",               "moved",                 1, "1", "1 when the displacement at the end is longer than the move threshold, else 0") \
  X(derived, flag, tilted,              "/summary/boxes/tilted",              "tilted",                1, "1", "1 when tilt exceeds the tilt threshold, else 0") \
  X(derived, flag, unstable,            "/summary/boxes/unstable",            "unstable",              1, "1", "1 when the box fell or moved while settling, else 0") \
  X(summary, f32,  first_move_time,     "/summary/boxes/first_move_time",     "first_move_time_s",     1, "s", "time of the first sample with a displacement longer than the move threshold; NaN if there is none, or without series")

/* clang-format on */

/* Whether a field is a member of the structures that a program gets; in C, where a function gives messages. */
#define HOLDFAST_IF_C_recorded(member) member
#define HOLDFAST_IF_C_copied(member) member
#define HOLDFAST_IF_C_derived(member) member
#define HOLDFAST_IF_C_message(member)
#define HOLDFAST_IF_C_stored(member)
#define HOLDFAST_IF_C_summary(member)
#define HOLDFAST_IF_PUBLIC_recorded(member) member
#define HOLDFAST_IF_PUBLIC_copied(member) member
#define HOLDFAST_IF_PUBLIC_derived(member) member
#define HOLDFAST_IF_PUBLIC_message(member) member
#define HOLDFAST_IF_PUBLIC_stored(member)
#define HOLDFAST_IF_PUBLIC_summary(member)

#endif /* HOLDFAST_OUTCOME_FIELDS_H */
