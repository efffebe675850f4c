#include "core/native/island/rest_proof.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/native/contact_kinematics.hpp"

namespace holdfast::internal::native {

namespace {

/// Where wall forces are asked for: cost of an impulse on a wall in the search for the least force on them, which
/// balances the load up to a motion as small. It changes no motion.
/// @measured Half: the same forces to 1e-5; ten times: the sum of all forces on a box that leans on a stop of 5 cm is
/// off by 2e-6 of its weight; a hundred times: rows are 6e-6 off.
constexpr double kWallCost = 1e-8;  // |g − a| h

/// Share of the least force by which the force that is found may exceed it, and of the weight below which a force is
/// none. It changes no motion.
/// @measured With 1e-6 rounding ends the search before in 2 of 12 loads; ten times: the same forces to 1e-5.
constexpr double kWallGap = 1e-5;  // of the force

}  // namespace

bool RestProof::rests(Scene& scene, const IslandView& island, const StepTerms& terms, bool leans,
                      IslandReport& report) {
  effort_ = options_.effort(island.bodies.size());
  Bodies& bodies = scene.bodies;
  const bool large = island.bodies.size() > kSmallIslandBodies;
  for (const std::uint32_t index : island.manifolds) scene.manifolds[index].slides = false;
  prepared_.prepare_rest(scene, island, terms, solve_.solver());
  if (balances(terms)) return true;
  const KnownBalances::Island known = known_as(scene, island);
  if (!leans && (balances_between(scene, known, terms) || balances_beyond(scene, known, terms, report))) {
    prepared_.store_rest_impulses(scene, island, terms.step);
    return true;
  }
  std::optional<bool> found = leans ? std::optional(false) : settle(terms, report);
  // Boxes that come to rest have nearly the right forces already; where they have not, later is soon enough.
  if (!found && !terms.reset_warm_start) found = false;
  std::optional<bool> judged;
  if (!found && large) found = judged = judge_by_motion(terms, report);
  bool rests = found ? *found : decide_balance(terms, report);
  // Where the acceleration has not changed, the last step is as good a start for a large island as what follows.
  if (!rests && large && !terms.reset_warm_start) return false;
  if (!rests && !judged) {
    SolveLimits limits = limits_after_reset(effort_);
    if (leans) {
      // How the bodies begin to move with the contacts of the round before.
      prepared_.start_from(island, [&](std::uint32_t body) {
        return body_vector(terms.step * bodies.last_step[body].acceleration,
                           terms.step * bodies.last_step[body].angular_acceleration);
      });
      limits = repeated_limits(limits, island);
    }
    const double speed = find_beginning_motion(limits, large ? kNegligible : 0.0, terms, report);
    // Forces that merely balance could lie in contacts that nothing pushes.
    if (terms.reset_warm_start && speed < kNoticeable * terms.velocity_unit && admit_pushed(scene)) {
      found = settle(terms, report);
      rests = found ? *found : decide_balance(terms, report);
    }
  }
  prepared_.store_rest_impulses(scene, island, terms.step);
  if (rests) {
    scene.balances.keep(known, terms.effective_gravity, terms.step, prepared_.problem);
    return true;
  }
  for (const std::uint32_t body : island.bodies) {
    bodies.last_step[body].acceleration = linear(prepared_.solution(body)) / terms.step;
    bodies.last_step[body].angular_acceleration = angular(prepared_.solution(body)) / terms.step;
  }
  return false;
}

/// How the bodies of the prepared island begin to move by Coulomb's law, from where the solve before has ended: their
/// largest speed, m/s. Where they hardly move it is as exact as a proof of rest, since they may be just above the limit
/// of balance.
/// @param tolerance of the velocities where they do move, over |g − a| h; 0: likewise
double RestProof::find_beginning_motion(SolveLimits limits, double tolerance, const StepTerms& terms,
                                        IslandReport& report) {
  const double exact = std::min(limits.tolerance, kBalanceTolerance * options_.rest_tolerance);
  limits.tolerance = std::max(exact, tolerance);
  solve_.solve(limits, terms, terms.step, report);
  if (limits.tolerance > exact && largest_speed(prepared_.problem) < kNoticeable * terms.velocity_unit) {
    limits.tolerance = exact;
    solve_.solve(limits, terms, terms.step, report);
  }
  return largest_speed(prepared_.problem);
}

/// Lets a proof of rest use those contacts beside bodies that the beginning motion pushes, and no others; at walls no
/// more than it pushes. False when it pushes none.
bool RestProof::admit_pushed(const Scene& scene) {
  ContactProblem& problem = prepared_.problem;
  bool any = false;
  for (std::size_t p = 0; p < problem.constraints.size(); ++p) {
    const Manifold& manifold = scene.manifolds[prepared_.sources[p].manifold];
    const bool wall = is_wall(scene.bodies, manifold);
    if (!wall && (supports(scene.bodies, manifold) || is_wall_or_roof(scene.bodies, manifold))) continue;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(problem.constraints[p].count); ++lane) {
      const double push = problem.constraints[p].impulse.row[0][lane];
      const double most = wall ? (1.0 + kSlack) * push : std::numeric_limits<double>::infinity();
      problem.normal_bounds[p].lane[lane] = push > 0.0 ? most : 0.0;
      any = any || push > 0.0;
    }
  }
  return any;
}

/// Whether the impulses of the prepared problem balance each of its bodies.
bool RestProof::balances(const StepTerms& terms) {
  return equilibrium_.residual(prepared_.problem, terms.velocity_unit) <= options_.rest_tolerance;
}

/// What the prepared island is known by.
KnownBalances::Island RestProof::known_as(const Scene& scene, const IslandView& island) {
  contacts_.clear();
  for (std::size_t p = 0; p < prepared_.sources.size(); ++p) {
    const Manifold& manifold = scene.manifolds[prepared_.sources[p].manifold];
    contacts_.push_back({manifold.a, manifold.b, prepared_.problem.constraints[p].count});
  }
  return {island.bodies.front(), contacts_};
}

/// Whether impulses that balance the prepared island follow from those that have balanced it before.
bool RestProof::balances_between(Scene& scene, const KnownBalances::Island& island, const StepTerms& terms) {
  ContactProblem& problem = prepared_.problem;
  start_impulses_.clear();
  for (const ContactConstraint& constraint : problem.constraints) start_impulses_.push_back(constraint.impulse);
  if (!scene.balances.combine(island, terms.effective_gravity, terms.step, problem)) return false;
  if (impulses_are_in_cones(problem) && impulses_are_in_bounds(problem) && balances(terms)) return true;
  scene.balances.forget(island);
  for (std::size_t p = 0; p < start_impulses_.size(); ++p) problem.constraints[p].impulse = start_impulses_[p];
  return false;
}

/// The same after a look for a balance under an acceleration beyond the present one.
bool RestProof::balances_beyond(Scene& scene, const KnownBalances::Island& island, const StepTerms& terms,
                                IslandReport& report) {
  if (!terms.reset_warm_start) return false;
  const std::optional<Vec3> gravity = scene.balances.beyond(island, terms.effective_gravity);
  if (!gravity) return false;
  ContactProblem& problem = prepared_.problem;
  // A stronger acceleration would have to push walls by more than what they were pushed by.
  const auto presses = [](const NormalBounds& bounds) {
    return std::any_of(bounds.lane.begin(), bounds.lane.end(),
                       [](double most) { return most > 0.0 && std::isfinite(most); });
  };
  const bool stronger = gravity->head<2>().norm() >= terms.effective_gravity.head<2>().norm();
  const std::vector<NormalBounds>& bounds = problem.normal_bounds;
  if (stronger && std::any_of(bounds.begin(), bounds.end(), presses)) return false;
  const ContactProblem before = problem;
  StepTerms there = terms;
  there.effective_gravity = *gravity;
  there.velocity_unit = gravity->norm() * terms.step;
  const Vec3 change = terms.step * (*gravity - terms.effective_gravity);
  for (BodyVector& free : problem.free_velocity) free = body_vector(linear(free) + change, angular(free));
  const bool found = settle(there, report).value_or(false);
  if (found) scene.balances.keep(island, *gravity, terms.step, problem);
  problem = before;
  const bool balanced = found && balances_between(scene, island, terms);
  scene.balances.note_beyond(island, balanced);
  return balanced;
}

/// Whether the prepared island rests, where its impulses balance it or its velocities are a motion that proves that no
/// impulses do.
std::optional<bool> RestProof::balance_of_prepared(const StepTerms& terms) {
  if (balances(terms)) return true;
  const double largest_impulse = prepared_.problem.mass() * terms.velocity_unit + prepared_.outside_impulse();
  if (equilibrium_.refutes_rest(prepared_.problem, largest_impulse)) return false;
  return std::nullopt;
}

/// Looks for forces in the contacts' cones that balance the prepared island. The problem is convex: it ends with them,
/// or with a motion that proves that there are none. The splitting is quick far from the limit of balance; near it, it
/// leaves the answer open.
std::optional<bool> RestProof::settle(const StepTerms& terms, IslandReport& report) {
  SolveLimits limits;
  limits.iterations = kCheckEvery;
  limits.tolerance = kBalanceTolerance * options_.rest_tolerance;
  limits.projection = Projection::orthogonal;
  limits.idle_penalty = kRestIdlePenalty;
  limits.plain_iterations = 0;
  limits.sticking = limits.sliding = kRestPenalty;
  limits.refit_share = 0.0;
  for (int done = 0; done < kSettlingIterations; done += limits.iterations) {
    solve_.solve(limits, terms, terms.step, report);
    if (const std::optional<bool> rests = balance_of_prepared(terms)) return rests;
  }
  return std::nullopt;
}

/// Whether the prepared island rests, by how it begins to move, which its step needs anyway where it does: it rests
/// where that leaves impulses that balance it, and moves where it clearly does. Else all is left as it was. An
/// iteration costs a fraction of one of the interior point method.
std::optional<bool> RestProof::judge_by_motion(const StepTerms& terms, IslandReport& report) {
  const ContactProblem before = prepared_.problem;
  SolveLimits limits = limits_after_reset(effort_);
  limits.tolerance = std::max(limits.tolerance, kNegligible);
  const SolveResult result = solve_.solve(limits, terms, terms.step, report);
  if (balances(terms)) return true;
  const double speed = largest_speed(prepared_.problem);
  if (speed >= kClearMotion * terms.velocity_unit && result.residual <= kClearResidual * speed) return false;
  prepared_.problem = before;
  // The solver has gone on to other penalties since.
  prepared_.problem.continues = false;
  return std::nullopt;
}

/// Decides by the interior point method whether forces balance the prepared island.
bool RestProof::decide_balance(const StepTerms& terms, IslandReport& report) {
  interior_point_.start(prepared_.problem, terms.velocity_unit);
  for (int i = 0; i < kInteriorIterations && interior_point_.iterate(prepared_.problem); ++i) {
    ++report.iterations;
    if (const std::optional<bool> rests = balance_of_prepared(terms)) return *rests;
  }
  return false;
}

/// Finds, of all impulses that balance the prepared island, those that press the least against the walls. False where
/// rounding ends that before.
bool RestProof::minimise_wall_forces(const Scene& scene, const StepTerms& terms) {
  const double cost = kWallCost * terms.velocity_unit;
  prepared_.minimise_wall_forces(scene, cost);
  interior_point_.start(prepared_.problem, terms.velocity_unit);
  // Where no force is needed, a share of the weight is as good as none.
  const double negligible = kWallGap * cost * prepared_.problem.mass() * terms.velocity_unit;
  for (int i = 0; i < kInteriorIterations && interior_point_.iterate(prepared_.problem); ++i)
    if (interior_point_.gap() <= kWallGap * std::max(prepared_.wall_cost(), negligible)) return true;
  return false;
}

void RestProof::find_resting_pushes(Scene& scene, const IslandView& island, const StepTerms& terms) {
  std::vector<SidePush>& pushes = scene.side_forces.of_resting(island);
  const auto is_pressed_wall = [&](std::uint32_t index) {
    const Manifold& manifold = scene.manifolds[index];
    return manifold.active && is_wall(scene.bodies, manifold);
  };
  if (std::any_of(island.manifolds.begin(), island.manifolds.end(), is_pressed_wall)) {
    prepared_.prepare_rest(scene, island, terms, solve_.solver());
    if (minimise_wall_forces(scene, terms)) {
      prepared_.add_pushes(scene, 1.0 / terms.step, pushes);
      return;
    }
  }
  for (const std::uint32_t index : island.manifolds) {
    const Manifold& manifold = scene.manifolds[index];
    const bool on_a = is_fixed(scene.bodies, manifold.a);
    if (!manifold.active || (!on_a && !is_fixed(scene.bodies, manifold.b))) continue;
    const std::size_t side = *pushed_side(scene, manifold, on_a ? manifold.a : manifold.b);
    for (std::size_t i = 0; i < at(manifold.contact.count); ++i)
      pushes.push_back({static_cast<std::uint32_t>(on_a ? manifold.b : manifold.a), side,
                        (on_a ? -1.0 : 1.0) * manifold.cached[i].force, manifold.contact.points[i].on_a});
  }
}

}  // namespace holdfast::internal::native
