#include "core/native/island/island_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/contact_kinematics.hpp"
#include "core/native/rotation_step.hpp"

namespace holdfast::internal::native {

namespace {

/// Root of the mean square of the bodies' speeds, m/s.
double mean_speed(const Bodies& bodies, const IslandView& island) {
  double squares = 0.0;
  for (const std::uint32_t body : island.bodies) squares += bodies.state.velocity[body].squaredNorm();
  return std::sqrt(squares / static_cast<double>(island.bodies.size()));
}

/// Whether exactly one body of the island moves: it may slide over others that stand, or hit them.
bool one_moves(const Bodies& bodies, const IslandView& island, const StepTerms& terms) {
  const auto moves = [&](std::uint32_t body) { return bodies.largest_speed(body) > kSmall * terms.velocity_unit; };
  return std::count_if(island.bodies.begin(), island.bodies.end(), moves) == 1;
}

}  // namespace

void IslandStepper::advance(Scene& scene, const IslandView& island, const StepTerms& terms, IslandReport& report) {
  effort_ = options_.effort(island.bodies.size());
  const bool crowd = island.bodies.size() > (terms.to_and_fro ? kMediumIslandBodies : kSmallIslandBodies);
  if (one_moves(scene.bodies, island, terms))
    effort_.slip_end_cuts = options_.small_island.slip_end_cuts;
  else if (crowd)
    effort_.impact_cuts = 0;
  const SolveLimits limits = step_limits(scene, island, terms);
  impact_cuts_ = slip_cuts_ = 0;
  for (double remaining = terms.step; remaining > 0.0;) {
    const ImpactTiming timing = impact_timing(scene.bodies, island, terms, effort_, crowd, impact_cuts_);
    find_sliding(scene, island, terms, effort_);
    impacts_.resolve(scene, island, terms, effort_, timing, remaining, report);
    const Part part = solve_part(scene, island, terms, limits, timing, remaining, report);
    report.residual = std::max(report.residual, part.result.residual);
    solve_.prepared.store_step_impulses(scene, island, part.length);
    slips_.find_ended(scene, island, terms, part.result.residual);
    const bool impact = part.impact_time < part.length - kLeastCut * terms.step;
    const double share = impact ? part.impact_time / part.length : 1.0;
    solve_.prepared.find_missing_velocities();
    if (scene.side_forces.wanted()) solve_.prepared.add_pushes(scene, share, scene.side_forces.of_step());
    motion_.move(scene.bodies, island, part.length, share);
    if (share == 1.0 && part.length == remaining) return;
    for (const std::uint32_t index : island.manifolds) scene.undo.emplace_back(index, scene.manifolds[index]);
    for (const std::uint32_t index : island.manifolds)
      if (update_manifold(scene, index, terms)) report.missed_contact = true;
    remaining -= share * part.length;
    ++(share < 1.0 ? impact_cuts_ : slip_cuts_);
  }
}

/// Prepares, solves and looks for events, until the step brings no overlap, and no slip, that the solve did not know
/// of. The part ends where a slip does.
IslandStepper::Part IslandStepper::solve_part(Scene& scene, const IslandView& island, const StepTerms& terms,
                                              const SolveLimits& limits, const ImpactTiming& timing, double remaining,
                                              IslandReport& report) {
  Part part{.length = remaining, .impact_time = std::numeric_limits<double>::infinity()};
  IslandProblem& prepared = solve_.prepared;
  closing_.begin(scene);
  bool repeated = false;
  for (std::size_t round = 0; round < kRepairRounds;) {
    prepared.prepare_step(scene, island, terms, part.length, solve_.solver(), timing.filter(part.length),
                          closing_.predicted());
    if (repeated) prepared.start_from(island, [&](std::uint32_t body) { return found_[body]; });
    part.result = solve_.solve(repeated ? repeated_limits(limits, island) : limits, terms, part.length, report);
    const double residual = part.result.residual;
    motion_.find(scene.bodies, island, terms, part.length);
    const ClosingContacts::Event event = closing_.find(scene, island, terms, effort_, timing, part.length);
    part.impact_time = event.time;
    repeated = event.activated || slips_.find_begun(scene, terms, effort_, residual);
    if (repeated) {
      prepared.store_step_impulses(scene, island, part.length);
      keep_solution(island, scene.bodies.count());
      if (event.activated) ++round;
      continue;
    }
    if (part.length != remaining) break;
    const int cuts = terms.oscillates() ? 2 * effort_.impact_cuts : effort_.slip_end_cuts;
    if (slip_cuts_ >= cuts) break;
    // The last cut is for a slip that ends: what follows it would be wrong by more than the turn of a slower slip.
    const bool turns = terms.oscillates() && slip_cuts_ + 1 < cuts;
    const bool uncut = impact_cuts_ + slip_cuts_ == 0;
    const double change = slips_.first_change(scene, terms, residual, uncut, turns, part.length);
    if (change >= part.length || change >= event.time) break;
    // Forces change where a slip ends or turns: what comes before is a step of its own.
    part.length = change;
  }
  return part;
}

/// How a moving step is solved. What may be left over shrinks with the speed of slow bodies. Where the effective
/// gravity has just changed, R is that of a proof of rest: with less of it along the tangents, the solve of a column
/// between floor and roof finds forces that hold it, though nothing pushes it against the roof (test `roof`). Where it
/// oscillates, the step before is a good guess for what moves already: solves take a half of the time, and the one of a
/// light box under a heavy one converges.
SolveLimits IslandStepper::step_limits(const Scene& scene, const IslandView& island, const StepTerms& terms) const {
  // How one body moves is determined, even in a large island. How a jammed crowd moves is not.
  const bool one = one_moves(scene.bodies, island, terms);
  const Effort& effort = one ? options_.small_island : effort_;
  SolveLimits limits;
  if (terms.reset_warm_start && (terms.refuted || !terms.oscillates())) {
    limits = limits_after_reset(effort);
  } else {
    // Where g − a oscillates, what a solve leaves holds back or lets slip in every cycle, and adds up.
    limits.tolerance = terms.oscillates() ? options_.small_island.tolerance : effort.tolerance;
    limits.iterations = terms.oscillates() ? effort.reset_iterations : effort.iterations;
    limits.sticking = effort.sticking_penalty;
    limits.sliding = effort.sliding_penalty;
  }
  const double speed = mean_speed(scene.bodies, island);
  const double slow = speed < terms.velocity_unit ? std::max(kSmall, speed / terms.velocity_unit) : 1.0;
  limits.mean_residual = slow * (terms.oscillates() ? kNegligible : effort.mean_residual);
  if (island.bodies.size() > kSmallIslandBodies) {
    limits.idle_penalty = kLargeIslandIdlePenalty;
    limits.refit_every = kLargeIslandCheckEvery;
  }
  limits.more_iterations = kMoreIterations * effort.iterations;
  if (one) {
    // What slides over boxes that stand shall not feel where one ends: what a solve leaves there stays in its path.
    limits.worst_residual = kNegligible;
    limits.more_iterations = effort.reset_iterations;
  }
  return limits;
}

/// Keeps the velocities that a solve has found, for the one that repeats it.
void IslandStepper::keep_solution(const IslandView& island, std::size_t bodies) {
  found_.resize(bodies);
  for (const std::uint32_t body : island.bodies) found_[body] = solve_.prepared.solution(body);
}

/// Finds a contact anew. True when it finds a missed one.
bool IslandStepper::update_manifold(Scene& scene, std::uint32_t index, const StepTerms& terms) const {
  Manifold& manifold = scene.manifolds[index];
  const double margin = speculative_margin(terms, scene.bodies, manifold.a, manifold.b);
  ContactSet contact = contact_now(scene.bodies, scene.sides, manifold.a, manifold.b, margin, manifold.contact.axis);
  if (scene.sinking.is_flush(scene.bodies, scene.sides, scene.manifolds, manifold.a, manifold.b, contact)) contact = {};
  const bool missed = is_missed_contact(contact, manifold.nearest_gap, options_.large_island.slop);
  update_contact(manifold, contact, scene.bodies);
  return missed;
}

void IslandStepper::correct_positions(Scene& scene, const IslandView& island, const StepTerms& terms) {
  effort_ = options_.effort(island.bodies.size());
  bool any = false;
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    if (manifold.nearest_gap >= -effort_.slop) continue;
    any = true;
    manifold.activate();
  }
  if (!any) return;
  correction_.find(scene, island, kCorrectionTolerance * effort_.slop);
  for (const std::uint32_t body : island.bodies) {
    if (!correction_.moves(static_cast<std::int32_t>(body))) continue;
    scene.bodies.state.position[body] += correction_.shift(body);
    rotate(scene.bodies.state.orientation[body], clamped(correction_.turn(body), kLargestTurn));
    scene.bodies.update_shape(body);
  }
  for (const std::uint32_t index : island.manifolds) {
    const Manifold& manifold = scene.manifolds[index];
    if (correction_.moves(manifold.a) || correction_.moves(manifold.b)) update_manifold(scene, index, terms);
  }
}

}  // namespace holdfast::internal::native
