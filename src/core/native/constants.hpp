#pragma once

#include <cstddef>
#include <cstdint>

#include "core/model/container_sides.hpp"

// The tuned constants of the native engine. Numbers that merely keep rounding out (a divisor that could be zero, a
// counter that could overflow) stand where they are used; what depends on the accuracy stands in `native_options`.
//
// Before a constant stands what it means and trades, after `@measured` what other values change, and behind it its
// unit, or what it is a share or a multiple of. `tools/parameters_page.py` makes docs/physics/parameters.md of this.
//
// Measured are the 90 worlds of `configs/` at `screening` (time and verdicts), and the 778 measurements of `holdfast
// validate --quick --engine native` without loads, 655 of which pass. "Insensitive" is a value where no case fails that
// passed, and verdicts change no more than wherever any bit does: 3 worlds of 90 at most, which tumble. "Noticed by"
// names the unit tests under `tests/core` that fail at half or at twice; a change of any bit of its scenes is noticed
// by `native_golden`, and a case that fails by the test of the recorded bounds.

namespace holdfast::internal::native {

// --- Rounding ---

/// What is smaller than this, over what it is compared with, is rounding: of a force at the limit of friction or at a
/// bound, of the length of a quaternion, and of a difference of effective gravities. As a square: the sine between two
/// edges whose product has no direction, and the length in a plane of an axis that points at it.
/// @measured 1e-12 for gravities, 1e-10 for edges, 1e-6 for axes: no bit changes.
inline constexpr double kRounding = 1e-9;  // of what it is compared with

/// What is right to one part in a hundred is right enough, where nothing is known more exactly: the way of a block that
/// slides alone, or, where a body turns, of one that nothing holds, under the mean of its samples, against that under
/// the samples, which is half of the error that walks under vibration may have at `standard`; and, over |g − a| h, the
/// residual of a step that may pass. Likewise bounds: a proof of rest may push a wall or the roof by this much more
/// than the body pressed against it in the last step, for the tolerance of that step; and an iteration of the interior
/// point method stops this much before the boundary of the cones.
/// @measured Ways of what slides: largest error of walks under vibration at `screening`, 0.4 %; half: 0.01 %, and full
/// loads under noise of 1,000 samples per second take 1.1 to 1.3 of their time; twice: 1.3 %, at `standard` 2 %, and
/// 0.7 to 1.0 of it. Of what nothing holds: of 1,218 draws of random worlds those beyond a limit at `screening`, 721; a
/// third: 718; three times: 714; without it: 706; at `reference`: 738. Forces: half and twice: insensitive. Interior
/// point method: 0.05 and 0.001: 1 % more and as many iterations, and the same answers.
inline constexpr double kSlack = 0.01;  // of what it is compared with

// --- Lengths ---

/// Surfaces this near are in touch, and points this near are one: far above rounding, far below what shows.
/// @measured Half and twice: insensitive.
inline constexpr double kTouch = 1e-7;  // m

/// Geometry below this length does not count: boxes whose outlines overlap by less touch along an edge or a corner, and
/// boxes of a packing do so everywhere, without holding each other; edges that pass by less do cross; faces that
/// separate boxes alike to this are equally good, less than `kAxisPreference`, which must decide first. Contacts are
/// looked for this far away at least, and supports with gaps up to this carry weight when a world starts.
/// @measured Half and twice: insensitive. Noticed by `box_box`, `clipping`.
inline constexpr double kContactTolerance = kLeastPlay;  // m

/// Boxes that overlap by less than this beside their contact, without what they have sunk, are flush and slide past
/// each other. More than the 10 µm of a box that tilts within its play to fixed boxes, less than a clearance of 0.1 mm.
/// A ledge that is narrower carries nothing.
/// @measured Of 300 random loads with flush tops, a box is more than 5 cm off in none at `standard`; half: in one;
/// twice: in none. Real steps from 60 µm on stop a box.
inline constexpr double kFlushWidth = 5e-5;  // m

/// Gap up to which points of a contact that carried a force in the last step count as touching in a proof of rest:
/// boxes that come to rest rock by a few micrometres for some steps.
/// @measured With 0.1 µm worlds under the road accelerations take 15 % more time at `screening`, with 50 µm 2 % less.
/// Half: case `row_of_3_at_wall` fails; twice: insensitive.
inline constexpr double kPressedTouch = kContactTolerance + kTouch;  // m

/// The separating axis of the step before is kept until another is better by this much, and edges have to separate
/// boxes this much better than faces, which give up to 8 points and edges one: more than the jitter of boxes at rest,
/// far less than the thinnest plate.
/// @measured Half and twice: insensitive, for each of the two. Noticed by `box_box`, `separating_axis`,
/// `box_box_random`.
inline constexpr double kAxisPreference = 2.0 * kContactTolerance;  // m

/// Points of contacts that are nearer than this are one: the point of two edges and a corner of a face's contact, where
/// points of the face's contact whose gap is larger by more than this are not beside it; and the points of one index in
/// two steps, which come in the order of the contact's corners, without a look at the others.
/// @measured Half and twice: insensitive, for each of the two.
inline constexpr double kSamePoint = 1e-3;  // m

/// Wider contacts are no flush boxes, whatever they have sunk: it bounds what is looked at a second time.
/// @measured 0.2 to 4 mm: no verdict changes.
inline constexpr double kNarrowWidth = 2.0 * kSamePoint;  // m

/// Cosine of 11°: faces whose normal is this near to that of a contact of edges are nearly parallel, and add their
/// points to it.
/// @measured Without these points 600 boxes that brake take a fifth more time, much of it for steps that are taken
/// again because a corner overlaps. 0.9: insensitive; 0.995: 600 boxes that brake take 7 % more time.
inline constexpr double kParallelFaces = 0.98;  // cosine

// --- Levels of speed, acceleration and residual ---

/// What is below this counts as none: slip, an approach, an acceleration that closes a contact with a neighbour, a
/// residual of how a large island begins to move or of one in which one body moves, and what is missing to the limit of
/// friction where a contact slides. A body that is slower falls asleep, and where all of an island are slower a proof
/// of rest is tried: what it stops is the rest of a path. As a share of `tolerance`: what a solve may leave whose warm
/// start is reset, because the acceleration has just changed; of `kTouch`: the overlap that a step may end with before
/// a contact is solved that can carry weight.
/// @measured Half and twice: insensitive, for each of its uses; 3 % more time with half of it as acceleration. As exact
/// as a proof of rest, the beginning motion takes a fifth more time of gentle loads. Sleep: 0.0025, 0.01: insensitive.
/// Rest: with 25 times as much, boxes that a vibration moves by less than 5 µm in a cycle fall up to 40 % short, in as
/// much time. Reset: 1e-5 of `tolerance` at `reference`: insensitive. Overlap: with 10 times as much a box that slides
/// over others is up to 1.4e-5 m off, in place of 1e-6 m.
inline constexpr double kNegligible = 1e-3;  // |g − a| h

/// Where no body of an island is faster none of them sleeps. Without this, 1 in 200 stacks of 9 to 40 boxes is held at
/// 1.002 of its limit. Where one of a large island is faster its impacts are located in time, and it is solved like a
/// small one. Impacts that are slower are not located in time: they close at the end of their step. What gravity does
/// between the impact and the end of the step is then lost, which is what a block that rocks lives on. Slip that is
/// faster, and more where a solve may leave more of it, makes friction kinetic: what sticks shows some slip until its
/// solve has converged. The interior point method starts from this speed. As a share: of the residual that may pass,
/// where bodies are slow, no less than this remains, since whether they move at all depends on it. And a change of g −
/// a up to this share of it is little: accelerations so near count as samples of a curve, of which a proof of rest
/// tries one ahead, and sleeping bodies are held by forces that are this much out of date at most. As an angle, in rad:
/// a slip that turns by more cuts a step where g − a oscillates. Over |g − a| h²: the overlap from which a contact that
/// a step is foretold to close takes part in its first solve.
/// @measured Residual, interior point method, overlap: half and twice: insensitive. Impacts: of about 227 random
/// worlds (bench/random_worlds.py) that an accuracy lets pass, those beyond a limit at `reference`, on average over
/// steps around the accuracy's: 8.5 at `screening` and 3 at `standard`; half: 9 and 4, with 17 and 9 % more time;
/// twice: 9 and 6, with 5 % less time of loads under the road accelerations. Slip: 0.01: 1 verdict of 90 bundled worlds
/// changes (`KineticFriction = 0.75`, `screening`); 0.04: none; the known answers pass with all. Changes of g − a:
/// half: real loads under sampled accelerations take 5 to 15 % more time; twice: 1 to 6 % less.
inline constexpr double kSmall = 0.025;  // |g − a| h

/// What is above this matters: an approach, or a change of velocity beyond that of the step before, is an impact; a
/// solve goes on, for `kMoreIterations`, while a component of its residual is larger, and an impact that leaves as much
/// of its speed is solved by the Gauss-Seidel method; and bodies that lean on others
/// are asked for a proof of rest where none begins to move faster. As a length, over |g − a| h²: where a hit makes
/// boxes overlap, pairs of the island that end the step this near are solved as well.
/// @measured Impacts: half: case `rocking_0.25_by_1_from_0.5` fails; twice: insensitive. Residual: five times as much:
/// 1 bundled load under one of two road accelerations gains energy in a step, by 1.4 mm of height; no time in any case.
/// Leaning: half and twice: insensitive; with a fifth the verdict of rows near their limit depends on the accuracy;
/// with three times worlds under the road accelerations take 11 % more time, and no verdict changes. Lengths: twice and
/// four times: insensitive.
inline constexpr double kNoticeable = 0.1;  // |g − a| h

/// What is above this is no small error of a step: slip does not end within the step, and friction opposes its mean
/// over the step; an impact rebounds, where slower ones do not, for rest would otherwise never come; and a solve whose
/// residual is larger, or is not a number, diverges.
/// @measured Slip: three quarters: insensitive; three times: case `braking_in_a_corner_mu_0.45` fails. Impacts: half:
/// no bit changes; twice: case `rebound_wall_e_0.5_v_0.1` fails.
inline constexpr double kLarge = 2.0;  // |g − a| h

// --- Contacts ---

/// A contact supports when its normal is this much along the vertical: it carries weight rather than merely touching.
/// @measured 0.25 and 0.9: no bit changes.
inline constexpr double kSupporting = 0.5;  // cosine

/// Cosine of 0.57°: edges of boxes aligned to this are either nearly parallel, with no cross product to speak of, or
/// span a plane that is nearly that of a face, whose contact covers them.
/// @measured 0.999975 and 0.9999: insensitive.
inline constexpr double kNearlyAligned = 0.99995;  // cosine

/// The speculative margin holds the distance that bodies approach by in the longest step, times this: velocities change
/// within the step.
/// @measured 0.6: case `closing_up_0.9371_s` fails; 1.2: insensitive. Noticed by `native_impacts`.
inline constexpr double kSpeculation = 2.0;  // of the distance

/// Least margin of a box's surroundings in the broad phase. It is doubled where a box leaves them within half of
/// `kHorizon`.
/// @measured Alone, without `kMatchDistance`, it changes no bit.
inline constexpr double kLeastSurroundings = 0.01;  // m

/// A contact point keeps its cached impulse from step to step while it moves less than this over one of its bodies.
/// @measured Half: case `scaled_10` fails; twice: insensitive.
inline constexpr double kMatchDistance = 2.0 * kLeastSurroundings;  // m

/// Steps that the engine plans for: a box's surroundings in the broad phase are to last so many at its speed, a
/// manifold without force stays active for so many solved steps, and twice as many is the longest wait between two
/// tries of a proof of rest.
/// @measured Half and twice: insensitive, for each of the three.
inline constexpr std::uint32_t kHorizon = 8;  // steps

// --- Steps and the events that cut them ---

/// Steps in which a body falls by its least horizontal extent. Poles and upright plates topple onto each other: with
/// fewer steps a row of many thin ones overlaps by a part of its thickness, and every step is taken again in halves.
/// @measured 150 poles of 1 cm x 1 cm x 60 cm that topple, at `screening`: 0.2 s, and more than 60 s at 60 steps per
/// second, which are 2.7 steps. Half and twice: no bit of a bundled world changes, none has boxes so thin.
inline constexpr double kThinSteps = 5.0;  // steps

/// Islands of more bodies are large islands.
/// @measured Half: insensitive; twice: 12 % more time.
inline constexpr std::size_t kSmallIslandBodies = 8;  // bodies

/// Largest rotation that is predicted for a step, rad.
/// @measured Half and a quarter: no bit changes.
inline constexpr double kLargestTurn = 0.5;  // rad

/// How long ago g − a has changed at most, where the acceleration goes to and fro; where the change before it was at
/// most as long before, it oscillates, and slips that turn cut steps.
/// @measured On the same random worlds half and twice are insensitive. Twice: loads under the road accelerations take
/// 4 % more time.
inline constexpr double kToAndFro = 0.15;  // s

/// Bodies of the largest islands whose impacts are located while the acceleration goes to and fro, and in which no body
/// sleeps: a tower falls into few small islands, and what holds it must be known in every step.
/// @measured Half: of towers of nine and ten boxes under two brakes some end up to 127 % of the largest displacement
/// too far at `standard`, in place of 4 and 2 %; random worlds under accelerations that oscillate take 0.97
/// (`screening`) and 0.87 of the time (`standard`), other loads as much; and of these worlds, 12 in place of 9 are
/// beyond a limit at `screening`. Twice, for impacts: insensitive; 1.5 times, for sleep: 600 boxes that brake take 9 %
/// more time. Without a limit on impacts, bundled loads under the noise of a truck take 1.5 (`screening`) and 1.3 times
/// as long (`standard`).
inline constexpr std::size_t kMediumIslandBodies = 2 * kSmallIslandBodies;  // bodies

/// Slip above this many times what a solve leaves, or may leave after a reset, is not due to the solve: it makes
/// friction kinetic, and what slides slips on as long as it has it.
/// @measured Five and ten times: insensitive, also the suite `oscillate` of `validate`.
inline constexpr double kResidualSlip = 2.0;  // of the residual

/// An event cuts a step no sooner than at this share of it, and leaves no less than this share: divided by less,
/// velocities would be anything.
/// @measured Half: no bit changes; twice: insensitive. Ten times: an impact 2e-4 of a step before its end is not
/// located. A step that is cut leaves no less than this share of it either: with 1e-9 of it in place of this, no bit
/// changes.
inline constexpr double kLeastCut = 1e-4;  // of the step

/// Rounds of a repair within a step, at most: of activating contacts, likewise of contacts that bodies lean on, and of
/// a position correction through the contacts of an island, in the mean.
/// @measured Contacts: half: the bits of 2 worlds change; twice: no bit changes. Positions: half and twice:
/// insensitive.
inline constexpr std::size_t kRepairRounds = 20;  // rounds

/// Times that a step is halved to see contacts in time that none showed before, or to go on where a solve does not
/// converge.
/// @measured Half: boxes overlap by up to 2.3 mm instead of 1.2 mm; twice: no bit changes. Noticed by `native_impacts`.
inline constexpr int kHalvings = 4;  // times

/// Overlap for which a step is halved where the contact was solved, over that where it was missed: a smaller step
/// leaves less, and so does the next position correction.
/// @measured Half: 300 boxes that brake take 6 % more time; twice: insensitive.
inline constexpr double kSolvedOverlap = 2.0;  // of the overlap

/// Times that a step is taken again with contacts that showed too late, before it is halved.
/// @measured None: 300 boxes that brake take a tenth more time, 600 a quarter; two: insensitive.
inline constexpr int kLateContactRounds = 1;  // times

/// Overlaps are corrected to this share of the overlap that is left alone. Where less is left, more bodies are
/// displaced, of which each may disturb its contacts: with a tenth, 600 boxes that brake take 20 % more time.
/// @measured Half: 600 boxes that brake take 5 % more time; twice: `tip_lands_on_its_side` gains ten times the energy
/// at `standard`.
inline constexpr double kCorrectionTolerance = 0.5;  // of the overlap

/// Sweeps of a position correction over the points of a contact, each time that it visits it.
/// @measured Twice and four times: insensitive.
inline constexpr int kCorrectionSweeps = 2;  // sweeps

// --- The contact solver ---

/// Penalty R of a contact over the mass that it carries, along the normal and where it sticks.
/// @measured Half: 7 % more time, and 4 measurements fail (`oblique_landing_u_3`, `slipping_stack_45`); twice: 3 % more
/// time, 1 fails and 2 pass.
inline constexpr double kStickingPenalty = 10.0;  // of the carried mass

/// The same in a moving step of a large island at `screening` and `standard`: it has few iterations.
/// @measured Half: 1 measurement fails (`stack_20_tips` at `screening`); twice: insensitive, also the errors of harsh
/// loads.
inline constexpr double kLargeIslandStickingPenalty = 0.5 * kStickingPenalty;  // of the carried mass

/// The same along the tangents where it slides, in all solves but those of the next two.
/// @measured A third: `reference` takes a third more time; a sixth: a column is held that must slide (test `roof`).
inline constexpr double kSlidingPenalty = 3.0;  // of the carried mass

/// The same in a moving step, except where the effective gravity has just changed. A large one needs more iterations
/// than these steps have until a slip ends. With `kSlidingPenalty` at `reference`, a box that slides over a row of 8
/// takes 2.3 to 2.8 times as many iterations, and comes up to 7e-5 m too short.
/// @measured Half: 1 measurement fails (`slipping_stack_30` at `screening`) and 4 pass; twice: 10 fail (`box_on_box_…`,
/// `pushing`, `slipping_stack_30`); six times, which is `kSlidingPenalty`: 29 fail (`lane_change`,
/// `braking_then_cornering`).
inline constexpr double kMovingSlidingPenalty = 0.5;  // of the carried mass

/// The same in a large island, where little of it leaves single points far from converged, and the solve goes on.
/// @measured Half: 1 measurement passes. A third: 400 boxes under braking take a fifth more time, with equal errors of
/// harsh loads. Twice: harsh loads take a tenth less time, and their largest errors grow by a half.
inline constexpr double kLargeIslandSlidingPenalty = 0.5 * kSlidingPenalty;  // of the carried mass

/// Mass that a contact without impulse counts as carrying, over its effective mass. With little, what is about to close
/// takes a third more iterations; with much, what separates is held back. What carries counts as more, what does not as
/// less, by the same factor.
/// @measured Half: 5 % more time, and 2 measurements fail (`oblique_landing_u_3`); twice: 7 % more time, and 3 fail.
inline constexpr double kIdlePenalty = 1.0 / kStickingPenalty;  // of the effective mass

/// The same in a moving step of a large island, which settles sooner with much.
/// @measured Half: 2 % more time; twice: 12 % more time.
inline constexpr double kLargeIslandIdlePenalty = 1.0;  // of the effective mass

/// A contact slides from this share of the friction disc's radius on.
/// @measured 0.9995 and 0.998: insensitive.
inline constexpr double kSlidingShare = 1.0 - kNegligible;  // of the disc's radius

/// Iterations between two looks at R, and, in a proof of rest, at the equilibrium residual, which costs as much as an
/// iteration.
/// @measured Half: 19 % more time, and 2 measurements fail; twice: case `stack_3_gap_1mm` fails at `screening`. For the
/// equilibrium residual: half: 18 % more time, and `slipping_stack_30` fails; twice: insensitive.
inline constexpr int kCheckEvery = 12;  // iterations

/// Iterations between two looks at R in a moving step of a large island: only solves that go on for longer than most
/// have a second factor.
/// @measured With `kCheckEvery`: 1 % more time of the loads of the road, and 600 boxes that brake take 13 % more; 24
/// and 32: 1 %, and 6 and 7 % more. Never: as much time, and twice as many worlds with friction coefficients above 1 do
/// not converge.
inline constexpr int kLargeIslandCheckEvery = 16;  // iterations

/// Iterations of a solve of a small island whose warm start is reset, at most, over those of other solves; of a large
/// one 2.
/// @measured 13 and 7 times: insensitive; four times in large islands at `reference`: insensitive.
inline constexpr int kResetIterations = 10;  // of `iterations`

/// R is fitted anew where more of the points than this call for another one.
/// @measured Half: 5 % more time; twice: case `stack_3_gap_1mm` fails at `screening`.
inline constexpr double kRefitShare = 0.2;  // of the points

/// Iterations before a solve may stop: the first only meets the start values.
/// @measured 2: 5 measurements fail (`box_on_box_…`, `stack_20_tips`); twice: 4 % more time, 3 fail (`mirrored_…` at
/// `reference`) and 8 pass.
inline constexpr int kLeastIterations = 3;  // iterations

/// Iterations of a solve of a large island that is repeated with other contacts or less friction, over those of the
/// first time: it starts from the impulses and velocities that it has ended with.
/// @measured Half: insensitive; twice: 600 boxes that brake take 9 % more time, 300 boxes 4 %.
inline constexpr double kRepeatedShare = 0.5;  // of the iterations

/// Iterations that a solve may take on top of its cap where the residual may not pass, over the cap; and those of a
/// second solve where it still may not, over those of the first. Likewise visits of the Gauss-Seidel method.
/// @measured Twice: 7 % more iterations at `standard`, and no measurement passes or fails.
inline constexpr int kMoreIterations = 2;  // of the cap

/// No component of a residual may be larger: this one moves a box by half of what it falls freely in a step. As a
/// share: of the speed of an impact, what its solve may leave.
/// @measured Half and twice: insensitive.
inline constexpr double kWorstResidual = 0.5;  // |g − a| h

/// Visits of the Gauss-Seidel method to the points of an island that the splitting does not solve, at most, where what
/// is left may pass, and `kMoreIterations` as many where it may not. A load of 80 boxes has some 300 points.
/// @measured Of 580 worlds with friction coefficients of 0.49 to 1.44 between boxes none fails, at `standard` and with
/// 960 steps per second. Without the method 7 and 94 of them do not converge; with it none and 1. Ten times: none and
/// none, and 16 loads of 600 boxes that brake take 1.6 times as long. Half and twice: 3 % less and 7 % more time of 600
/// boxes.
inline constexpr std::size_t kGaussSeidelVisits = 2000000;  // visits

/// Share of the step to the impulse of its law that a point takes in a sweep.
/// @measured Of 6,438 solves of 2,992 worlds with coefficients of 0.49 to 1.56 between boxes that the method is asked
/// for, 3.0 % are not ended; 1: 3.6 %, with a sixth more visits. With five of the coefficients: 3.4 %; 0.6: 3.6 %, with
/// a sixth more visits.
inline constexpr double kGaussSeidelRelaxation = 0.7;  // of the step

/// Iterations of a solve before Anderson acceleration begins. Most solves end within them, and an iteration that is not
/// accelerated takes less time.
/// @measured 250 random worlds take 0.86 and 0.91 of the time that they take without acceleration, at `screening` and
/// `standard`; with 30 iterations 0.82 and 0.94, and a wedged column under a roof is held beyond its limit in 1 of
/// 420 runs.
inline constexpr int kPlainIterations = 100;  // iterations

/// Differences of iterates that Anderson acceleration keeps: its depth.
inline constexpr std::size_t kAndersonDepth = 5;  // iterates

/// Largest normal impulse at a point that Anderson acceleration may lead to, over that of the weight of all bodies of
/// the solve, or of an impact. Without a limit the forces of a load that jams between floor and roof, which the
/// residual hardly sees, grow without one.
/// @measured A third: the same forces, and a tower of ten slides 3e-6 less exactly; 3 times: in 1 of 12 bundled worlds
/// forces between floor and roof are 4 times the weight, 33 times: in 4 of them, 40 times; without a limit: 20,000
/// times.
inline constexpr double kAndersonImpulse = 3.0;  // of the weight

/// Factor by which the residual (squared norm) may grow before Anderson acceleration drops its iterates.
/// @measured Half: 5 % more iterations at `screening`; twice: insensitive.
inline constexpr double kAndersonGrowth = 2.0;  // of the square

/// Iterations without acceleration after that, twice as many each time. Where boxes just come to rest, iterates from
/// the time when they still slid lead past rest, and applied again at once, back to sliding, for ever.
/// @measured 3 and 6: insensitive. Noticed by `anderson`.
inline constexpr int kAndersonPause = 2;  // iterations

// --- Sleep ---
//
// Measured at `screening` on 32 real loads under three accelerations of the road (96 worlds), half of them with 1 mm of
// play, on 8 loads of 300 boxes and 6 of 600 that brake or change lane, whose time scatters by 5 % with rounding alone,
// and on the harsh loads of docs/evidence/peers.md. No measurement of `validate` passes or fails with any of these
// values.

/// Steps in which no point of a body is faster than `kNegligible` |g − a| h, nor faster than in the step before, after
/// which it falls asleep.
/// @measured Twice: harsh loads take 9 % more time and 600 boxes that brake a sixth, with equal errors.
inline constexpr std::uint32_t kSlowSteps = 1;  // steps

/// All bodies are awake in every step of this count: how long one may be held that must begin to move unnoticed. The
/// errors of the few iterations of these steps keep many bodies awake for some steps more.
/// @measured Half: 600 boxes that brake take 8 % more time, 300 boxes and gentle loads 2 %, with equal errors and
/// verdicts; twice: 300 boxes take 4 % less and gentle loads 8 %, likewise.
inline constexpr std::uint32_t kWakeEvery = 32;  // steps

/// Bodies that are this many contacts away from one that is hit do not sleep in the step.
/// @measured None: insensitive; twice: 600 boxes that brake take 4 % more time.
inline constexpr int kHitLayers = 1;  // contacts

/// Least contact force of what stays on a body that sleeps, against g − a and over what balances it: those that moving
/// bodies carry are awake.
/// @measured 0.5: 600 boxes that brake take 3 % less time, 300 boxes 7 %, and in 3 of 256 real loads energy rises by
/// more than a tenth of a millimetre times the weight, in none with this value; none: both take a sixth less, and boxes
/// stay in the air for up to `kWakeEvery` steps where what carries them is drawn away. Noticed by `sleeping_bodies`.
inline constexpr double kSleepingSupport = 0.8;  // of the force

/// Change of the force on a sleeping body and its sleeping neighbours that wakes it, over their mass times |g − a|.
/// @measured Half: 600 boxes that brake take 5 % more time; twice: 7 % less.
inline constexpr double kSleepingLoadChange = 1.0;  // of m |g − a|

// --- Rest ---

/// Residual of the velocities in a proof of rest, over the equilibrium residual that it is to reach.
/// @measured A fifth: insensitive.
inline constexpr double kBalanceTolerance = 0.5;  // of `rest_tolerance`

/// Iterations of the splitting in a proof of rest, after which the interior point method decides: the splitting is
/// quick far from the limit of balance, where most proofs are.
/// @measured A quarter: 6 % more time on real loads under the road accelerations and 35 % on gentle ones; half: 1 and
/// 14 %; three quarters and twice: 1 and 5 to 8 %.
inline constexpr int kSettlingIterations = 40;  // iterations

/// Balances that are kept of an island at rest. Two hold all accelerations along a line between them, three those of a
/// triangle; more follow a curve in the plane.
/// @measured 3: proofs under a braking with vibration, 50 samples per second, take a fifth more time; 12: 7 % less. A
/// lane change: insensitive.
inline constexpr std::size_t kKnownBalances = 8;  // balances

/// How far such a try goes at least, over the distance from the centre of what is known: after tries that fail it goes
/// half as far each time, and then there are none.
/// @measured A fifth and a fiftieth: insensitive.
inline constexpr double kLeastReach = 0.5;  // of the distance

/// Penalty R of the splitting in a proof of rest, over the mass that a contact carries.
/// @measured Half: 4 % more time; twice: 5 % more time.
inline constexpr double kRestPenalty = 100.0;  // of the carried mass

/// `kIdlePenalty` of a proof of rest: after one that fails, the step goes on from its impulses.
/// @measured Half: insensitive; twice: 6 % more time.
inline constexpr double kRestIdlePenalty = 1.0 / kRestPenalty;  // of the effective mass

/// Iterations of the interior point method in a proof of rest, at most.
/// @measured 774 proofs that the splitting left open took 5 (refuted) to 20 (balanced to 1e-6 exactly at the limit of
/// friction), 39 at most.
inline constexpr int kInteriorIterations = 2 * kSettlingIterations;  // iterations

/// Least share of the complementarity that an iteration aims to keep (Mehrotra's σ).
/// @measured With 0.01, 11 of 774 proofs lose centrality near the limit of friction and end in rounding; half: 6 %
/// fewer iterations, and the same answers.
inline constexpr double kInteriorLeastCentring = 0.1;  // 1

/// Where the splitting leaves the balance of a large island open, the island moves if by Coulomb's law it begins to
/// with this speed, over |g − a| h, at least, and with a residual of at most `kClearResidual` of it.
/// @measured Of 1221 such islands of real and generated loads, 355 move so, none of which has a balance; 563 have one,
/// and begin to move with 0.17 at most. Half: 1 % less time.
inline constexpr double kClearMotion = 0.5;  // |g − a| h

/// Residual of that motion, at most, over its speed.
/// @measured Half: insensitive.
inline constexpr double kClearResidual = 0.5;  // of the speed

}  // namespace holdfast::internal::native
