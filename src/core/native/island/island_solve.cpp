#include "core/native/island/island_solve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace holdfast::internal::native {

SolveResult IslandSolve::solve(SolveLimits limits, const StepTerms& terms, double step, IslandReport& report) {
  const double unit = terms.effective_gravity.norm() * step;
  limits.velocity_unit = unit > 0.0 ? unit : kNegligible * step;
  const SolveResult result = solve_once(limits, report);
  const bool diverged = !(result.residual < kLarge * limits.velocity_unit);
  const bool may_pass = result.residual <= limits.worst_residual * limits.velocity_unit;
  if (!diverged && (limits.more_iterations == 0 || may_pass)) return result;
  SolveLimits careful = limits;
  careful.accelerate = false;
  careful.more_iterations = kMoreIterations * (limits.iterations + limits.more_iterations);
  if (diverged) {
    careful.sticking *= kCarefulShare;
    careful.sliding *= kCarefulShare;
    prepared.problem.reset_warm_start();
  }
  const SolveResult second = solve_once(careful, report);
  // A step that has been halved is not solved where a whole one would not be: what is left counts over a whole step.
  const double worst = kWorstResidual * terms.longest_step / step * limits.velocity_unit;
  if (!terms.halved || second.residual <= worst) return second;
  return solve_by_rounds(limits.velocity_unit, second, report);
}

/// Solves the prepared problem where the splitting does not: where boxes are wedged with much friction it may go round
/// in circles. Coulomb's law with a sliding velocity that is known is a convex problem, in which the normal velocity
/// counts as larger by μ |u_t|, and |u_t| is then found in rounds (V. Acary, F. Cadoux, C. Lemaréchal, J. Malick, "A
/// formulation of the linear discrete Coulomb friction problem via convex optimization", ZAMM 91, 2011):
///
///   min ½ (v − v*) · M (v − v*)   over v with J v + bias + μ |u_t| n ∈ K*,   u = J v + bias.
///
/// The residual is the last change of μ |u_t|. Where that stays larger than what was left, nothing changes.
/// @param left what the splitting has left
SolveResult IslandSolve::solve_by_rounds(double unit, const SolveResult& left, IslandReport& report) {
  ContactProblem& problem = prepared.problem;
  const ContactProblem before = problem;
  // The arms of mid step would make the problem one that is not convex.
  problem.mid_arms.clear();
  double mass = 0.0;
  for (const ProblemBody& body : problem.bodies) mass += body.mass;
  const double negligible = kNegligible * mass * unit * unit;     // kg m²/s²
  std::vector<Lanes> added(problem.constraints.size(), Lanes{});  // μ |u_t|, m/s
  SolveResult result;
  result.residual = std::numeric_limits<double>::infinity();
  for (std::size_t round = 0; round < kRepairRounds && !(result.residual <= kNoticeable * unit); ++round) {
    for (ContactConstraint& constraint : problem.constraints) constraint.impulse = {};
    interior_point_.start(problem, unit);
    for (int i = 0; i < kInteriorIterations && interior_point_.iterate(problem); ++i) {
      ++report.iterations;
      if (interior_point_.gap() <= negligible) break;
    }
    const double last = std::exchange(result.residual, 0.0);
    for (std::size_t p = 0; p < added.size(); ++p) {
      ContactConstraint& constraint = problem.constraints[p];
      for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane) {
        auto& velocity = constraint.contact_velocity.row;
        velocity[0][lane] = std::max(0.0, velocity[0][lane] - added[p][lane]);
        const double sliding = constraint.friction * std::hypot(velocity[1][lane], velocity[2][lane]);
        result.residual = std::max(result.residual, std::abs(sliding - added[p][lane]));
        constraint.velocity_bias.row[0][lane] += sliding - added[p][lane];
        added[p][lane] = sliding;
      }
    }
    // Where no motion satisfies all contacts, the sliding velocity grows from round to round.
    if (round > 1 && !(result.residual < last)) break;
  }
  if (!(result.residual < left.residual)) {
    problem = before;
    return left;
  }
  for (std::size_t p = 0; p < added.size(); ++p)
    problem.constraints[p].velocity_bias = before.constraints[p].velocity_bias;
  problem.continues = false;
  return result;
}

SolveResult IslandSolve::solve_once(const SolveLimits& limits, IslandReport& report) {
  const SolveResult result = solver_->solve(prepared.problem, limits);
  assert(impulses_are_in_cones(prepared.problem));
  report.iterations += static_cast<std::uint64_t>(result.iterations);
  return result;
}

SolveLimits limits_after_reset(const Effort& effort) {
  SolveLimits limits;
  limits.tolerance = effort.reset_tolerance;
  limits.iterations = effort.reset_iterations;
  limits.accelerate = true;
  return limits;
}

SolveLimits repeated_limits(SolveLimits limits, const IslandView& island) {
  if (island.bodies.size() > kSmallIslandBodies)
    limits.iterations = std::max(kLeastIterations, static_cast<int>(kRepeatedShare * limits.iterations));
  return limits;
}

}  // namespace holdfast::internal::native
