#include "core/native/island_stepper.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

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

/// Turns a body by a rotation vector, rad.
void rotate(Bodies& bodies, std::uint32_t body, const Vec3& turn) {
  if (turn == Vec3::Zero()) return;
  Rotation& orientation = bodies.state.orientation[body];
  orientation = (rotation_by(turn) * orientation).normalized();
}

}  // namespace

void IslandStepper::advance(Scene& scene, const IslandView& island, const StepTerms& terms, IslandReport& report) {
  effort_ = options_.effort(island.bodies.size());
  const std::size_t located = terms.to_and_fro ? kLocatedIslandBodies : kSmallIslandBodies;
  if (island.bodies.size() > located) effort_.impact_cuts = 0;
  const SolveLimits limits = step_limits(scene, island, terms);
  impact_cuts_ = slip_end_cuts_ = 0;
  for (double remaining = terms.step; remaining > 0.0;) {
    locates_impacts_ = impact_cuts_ < effort_.impact_cuts;
    turning_speed_ = turning_speed(scene.bodies, island, terms);
    find_sliding(scene, island, terms);
    resolve_impacts(scene, island, terms, remaining, report);
    const Part part = solve_part(scene, island, terms, limits, remaining, report);
    report.residual = std::max(report.residual, part.result.residual);
    find_ended_slips(scene, island, terms, part.result.residual);
    prepared_.store_step_impulses(scene, island, part.length);
    const bool impact = part.impact_time < part.length - kLeastRemainder * terms.step;
    const double share = impact ? part.impact_time / part.length : 1.0;
    if (scene.notes_pushes) prepared_.add_pushes(scene, share, scene.pushes);
    integrate(scene, island, part.length, share);
    if (share == 1.0 && part.length == remaining) return;
    for (const std::uint32_t index : island.manifolds) scene.undo.emplace_back(index, scene.manifolds[index]);
    for (const std::uint32_t index : island.manifolds)
      if (update_manifold(scene, index, terms)) report.missed_contact = true;
    remaining -= share * part.length;
    ++(share < 1.0 ? impact_cuts_ : slip_end_cuts_);
  }
}

/// Prepares, solves and looks for events, until the step brings no overlap, and no slip, that the solve did not know
/// of. The part ends where a slip does.
IslandStepper::Part IslandStepper::solve_part(Scene& scene, const IslandView& island, const StepTerms& terms,
                                              const SolveLimits& limits, double remaining, IslandReport& report) {
  Part part{.length = remaining, .impact_time = std::numeric_limits<double>::infinity()};
  predicted_.assign(scene.manifolds.size(), 0);
  bool repeated = false;
  for (int round = 0; round < kActivationRounds;) {
    prepared_.prepare_step(scene, island, terms, part.length, *solver_, point_filter(terms, part.length), predicted_);
    if (repeated) prepared_.start_from(island, [&](std::uint32_t body) { return found_[body]; });
    part.result = solve(repeated ? repeated_limits(limits, island) : limits, terms, part.length, report);
    find_mean_velocities(scene.bodies, island, terms, part.length);
    const Event event = find_overlap(scene, island, terms, part.length);
    part.impact_time = event.time;
    repeated = event.activated || find_begun_slips(scene, terms, part.result.residual);
    if (repeated) {
      prepared_.store_step_impulses(scene, island, part.length);
      keep_solution(island, scene.bodies.count());
      if (event.activated) ++round;
      continue;
    }
    if (slip_end_cuts_ >= effort_.slip_end_cuts || part.length != remaining) break;
    const double slip_end = first_slip_end(scene, terms, part.length);
    if (slip_end >= part.length || slip_end >= event.time) break;
    // Forces change where a slip ends: what comes before is a step of its own.
    part.length = slip_end;
  }
  return part;
}

/// How a moving step is solved. What may be left over shrinks with the speed of slow bodies. Where the effective
/// gravity has just changed, R is that of a proof of rest: with less of it along the tangents, the solve of a column
/// between floor and roof finds forces that hold it, though nothing pushes it against the roof (test `roof`).
SolveLimits IslandStepper::step_limits(const Scene& scene, const IslandView& island, const StepTerms& terms) const {
  SolveLimits limits;
  if (terms.reset_warm_start) {
    limits = limits_after_reset();
  } else {
    limits.tolerance = effort_.tolerance;
    limits.iterations = effort_.iterations;
    limits.sticking = effort_.sticking_penalty;
    limits.sliding = effort_.sliding_penalty;
    limits.refit_share = effort_.refit_share;
  }
  const double speed = mean_speed(scene.bodies, island);
  const double slow = speed < terms.velocity_unit ? std::max(kSlowShare, speed / terms.velocity_unit) : 1.0;
  limits.mean_residual = slow * effort_.mean_residual;
  if (island.bodies.size() > kSmallIslandBodies) {
    limits.idle_penalty = kLargeIslandIdlePenalty;
    limits.refit_every = kLargeIslandRefitEvery;
  }
  limits.more_iterations = kMoreIterations * effort_.iterations;
  return limits;
}

/// How a solve is made where the effective gravity has just changed: to the end, since the last step is no guess.
SolveLimits IslandStepper::limits_after_reset() const {
  SolveLimits limits;
  limits.tolerance = effort_.reset_tolerance;
  limits.iterations = effort_.reset_iterations;
  limits.accelerate = true;
  return limits;
}

/// How a solve is repeated, with other contacts or less friction, from where it has ended.
SolveLimits IslandStepper::repeated_limits(SolveLimits limits, const IslandView& island) const {
  if (island.bodies.size() > kSmallIslandBodies)
    limits.iterations = std::max(kLeastIterations, static_cast<int>(kRepeatedShare * limits.iterations));
  return limits;
}

/// Keeps the velocities that a solve has found, for the one that repeats it.
void IslandStepper::keep_solution(const IslandView& island, std::size_t bodies) {
  found_.resize(bodies);
  for (const std::uint32_t body : island.bodies) found_[body] = prepared_.solution(body);
}

/// Solves what is prepared. Where the residual may not pass, it goes on for longer, and where the iteration diverges,
/// it starts again with less of the penalty R.
SolveResult IslandStepper::solve(SolveLimits limits, const StepTerms& terms, double step, IslandReport& report) {
  const double unit = terms.effective_gravity.norm() * step;
  limits.velocity_unit = unit > 0.0 ? unit : 1e-3 * step;
  const SolveResult result = solve_once(limits, report);
  const bool diverged = !(result.residual < kDivergedResidual * limits.velocity_unit);
  const bool may_pass = result.residual <= limits.worst_residual * limits.velocity_unit;
  if (!diverged && (limits.more_iterations == 0 || may_pass)) return result;
  SolveLimits careful = limits;
  careful.accelerate = false;
  careful.more_iterations = kMoreIterations * (limits.iterations + limits.more_iterations);
  if (diverged) {
    careful.sticking *= kCarefulShare;
    careful.sliding *= kCarefulShare;
    prepared_.problem.reset_warm_start();
  }
  return solve_once(careful, report);
}

SolveResult IslandStepper::solve_once(const SolveLimits& limits, IslandReport& report) {
  const SolveResult result = solver_->solve(prepared_.problem, limits);
  assert(impulses_are_in_cones(prepared_.problem));
  report.iterations += static_cast<std::uint64_t>(result.iterations);
  return result;
}

/// Whether a body has its new velocity from the start of the step, because an impact too slow to be located makes it
/// jump there: with the old one bodies would overlap.
bool IslandStepper::jumps(const Bodies& bodies, std::uint32_t body, const StepTerms& terms, double step) const {
  if (!prepared_.has_late_impact()) return false;
  if (prepared_.has_late_impact(body)) return true;
  // Where the effective gravity has just changed, every velocity jumps: only bodies at a late impact count.
  if (terms.reset_warm_start) return false;
  const BodyVector& end = prepared_.solution(body);
  const Vec3 change = linear(end) - bodies.state.velocity[body] - step * bodies.acceleration[body];
  const Vec3 turn = angular(end) - bodies.state.angular_velocity[body] - step * bodies.angular_acceleration[body];
  return change.norm() + bodies.radius[body] * turn.norm() > kJumpShare * terms.velocity_unit;
}

/// Finds the velocities that move the bodies through the part of the step that has been solved, where nothing cuts it.
void IslandStepper::find_mean_velocities(const Bodies& bodies, const IslandView& island, const StepTerms& terms,
                                         double step) {
  mean_velocity_.resize(bodies.count());
  jumps_.resize(bodies.count());
  for (const std::uint32_t body : island.bodies) {
    const Vec3 v = linear(prepared_.solution(body));
    const Vec3 w = angular(prepared_.solution(body));
    jumps_[body] = jumps(bodies, body, terms, step) ? 1 : 0;
    // The trapezoid is exact under constant forces.
    mean_velocity_[body] = jumps_[body] != 0 ? body_vector(v, w)
                                             : body_vector(0.5 * (bodies.state.velocity[body] + v),
                                                           0.5 * (bodies.state.angular_velocity[body] + w));
  }
}

/// Moves the bodies through a share of the solved step.
void IslandStepper::integrate(Scene& scene, const IslandView& island, double step, double share) {
  Bodies& bodies = scene.bodies;
  const double time = share * step;
  for (const std::uint32_t body : island.bodies) {
    Vec3& v = bodies.state.velocity[body];
    Vec3& w = bodies.state.angular_velocity[body];
    const Vec3 v_end = linear(prepared_.solution(body));
    const Vec3 w_end = angular(prepared_.solution(body));
    const bool whole = share == 1.0;
    const bool jump = whole && jumps_[body] != 0;
    const Vec3 v_new = whole ? v_end : Vec3(v + share * (v_end - v));
    Vec3 w_new = whole ? w_end : Vec3(w + share * (w_end - w));
    const Vec3 v_mean = whole ? linear(mean_velocity_[body]) : Vec3(0.5 * (v + v_new));
    const Vec3 w_mean = whole ? angular(mean_velocity_[body]) : Vec3(0.5 * (w + w_new));
    bodies.acceleration[body] = jump ? Vec3::Zero() : Vec3((v_end - v) / step);
    bodies.angular_acceleration[body] = jump ? Vec3::Zero() : Vec3((w_end - w) / step);
    bodies.state.position[body] += time * v_mean;
    rotate(bodies, body, time * w_mean);
    bodies.update_shape(body);
    if (whole && prepared_.turns(body))
      w_new = bodies.inertia(body).inverse() * (prepared_.problem.bodies[prepared_.row(body)].inertia * w_end);
    v = v_new;
    w = w_new;
  }
}

/// Finds a contact anew. True when it finds a missed one.
bool IslandStepper::update_manifold(Scene& scene, std::uint32_t index, const StepTerms& terms) const {
  Manifold& manifold = scene.manifolds[index];
  const double margin = speculative_margin(terms, scene.bodies, manifold.a, manifold.b);
  ContactSet contact = contact_now(scene.bodies, scene.sides, manifold.a, manifold.b, margin, manifold.contact.axis);
  if (scene.sinking.is_flush(scene.bodies, scene.sides, scene.manifolds, manifold.a, manifold.b, contact)) contact = {};
  const bool missed = is_missed_contact(contact, manifold.nearest_gap, options_.missed_contact_overlap);
  update_contact(manifold, contact, scene.bodies);
  return missed;
}

void IslandStepper::correct_positions(Scene& scene, const IslandView& island, const StepTerms& terms) {
  effort_ = options_.effort(island.bodies.size());
  bool any = false;
  for (const std::uint32_t index : island.manifolds) {
    Manifold& manifold = scene.manifolds[index];
    if (manifold.nearest_gap >= -effort_.overlap) continue;
    any = true;
    manifold.activate();
  }
  if (!any) return;
  correction_.find(scene, island, kCorrectionTolerance * effort_.overlap);
  for (const std::uint32_t body : island.bodies) {
    if (!correction_.moves(static_cast<std::int32_t>(body))) continue;
    scene.bodies.state.position[body] += correction_.shift(body);
    rotate(scene.bodies, body, clamped(correction_.turn(body), kLargestTurn));
    scene.bodies.update_shape(body);
  }
  for (const std::uint32_t index : island.manifolds) {
    const Manifold& manifold = scene.manifolds[index];
    if (correction_.moves(manifold.a) || correction_.moves(manifold.b)) update_manifold(scene, index, terms);
  }
}

}  // namespace holdfast::internal::native
