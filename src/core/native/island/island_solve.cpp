#include "core/native/island/island_solve.hpp"

#include <algorithm>
#include <cassert>

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
  if (limits.more_iterations == 0 || second.residual <= kWorstResidual * limits.velocity_unit) return second;
  if (!(second.residual < kLarge * limits.velocity_unit)) prepared.problem.reset_warm_start();
  const SolveResult last =
      gauss_seidel_.solve(prepared.problem, limits.worst_residual * limits.velocity_unit, kGaussSeidelSweeps);
  report.iterations += static_cast<std::uint64_t>(last.iterations);
  return last;
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
