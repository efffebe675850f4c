#include "core/native/island/island_solve.hpp"

#include <algorithm>
#include <cassert>

namespace holdfast::internal::native {

SolveResult IslandSolve::solve(SolveLimits limits, const StepTerms& terms, double step, IslandReport& report) {
  const double unit = terms.effective_gravity.norm() * step;
  limits.velocity_unit = unit > 0.0 ? unit : kNegligible * step;
  const auto is_within = [&](const SolveResult& result, double bound) {
    return result.residual <= bound * limits.velocity_unit;
  };
  SolveResult result = solve_once(limits, report);
  if (limits.more_iterations == 0 || is_within(result, kNoticeable)) return result;
  const auto solve_longer = [&] {
    limits.plain_iterations = kPlainIterations;
    limits.more_iterations = kMoreIterations * (limits.iterations + limits.more_iterations);
    return solve_once(limits, report);
  };
  if (is_within(result, kLarge)) {
    result = solve_longer();
    if (is_within(result, kWorstResidual)) return result;
  }
  // From the impulses of the step before, the splitting may diverge where it converges from none.
  prepared.problem.reset_warm_start();
  result = solve_longer();
  if (is_within(result, kWorstResidual)) return result;
  if (!is_within(result, kLarge)) prepared.problem.reset_warm_start();
  return solve_by_points({.tolerance = limits.worst_residual * limits.velocity_unit,
                          .worst_residual = kWorstResidual * limits.velocity_unit},
                         report);
}

SolveResult IslandSolve::solve_once(const SolveLimits& limits, IslandReport& report) {
  const SolveResult result = solver_->solve(prepared.problem, limits);
  assert(impulses_are_in_cones(prepared.problem));
  report.iterations += static_cast<std::uint64_t>(result.iterations);
  return result;
}

SolveResult IslandSolve::solve_by_points(const PointLimits& limits, IslandReport& report) {
  const SolveResult result = gauss_seidel_.solve(prepared.problem, limits);
  report.iterations += static_cast<std::uint64_t>(result.iterations);
  return result;
}

SolveLimits limits_after_reset(const Effort& effort) {
  SolveLimits limits;
  limits.tolerance = effort.reset_tolerance;
  limits.iterations = effort.reset_iterations;
  limits.plain_iterations = 0;
  return limits;
}

SolveLimits repeated_limits(SolveLimits limits, const IslandView& island) {
  if (island.bodies.size() > kSmallIslandBodies)
    limits.iterations = std::max(kLeastIterations, static_cast<int>(kRepeatedShare * limits.iterations));
  return limits;
}

}  // namespace holdfast::internal::native
