#pragma once

#include <cstdint>
#include <memory>

#include "core/native/island/island_problem.hpp"
#include "core/native/native_options.hpp"
#include "core/native/scene.hpp"
#include "core/native/solver/contact_solver.hpp"
#include "core/native/solver/gauss_seidel.hpp"

namespace holdfast::internal::native {

/// What an island's step has cost and reached.
struct IslandReport {
  std::uint64_t iterations = 0;
  double residual = 0.0;         ///< worst of the solves of its parts, m/s
  double impact_residual = 0.0;  ///< worst of the solves of its impacts, over the speed of the fastest one
  bool missed_contact = false;   ///< bodies overlap where their last contact did not show it, see `is_missed_contact`
};

/// The contact problem of an island, and the solver that solves it. Holds work buffers alone.
class IslandSolve {
 public:
  explicit IslandSolve(std::unique_ptr<ContactSolver> solver) : solver_(std::move(solver)) {}

  IslandProblem prepared;  ///< what is being solved

  ContactSolver& solver() { return *solver_; }

  /// Solves what is prepared. Where the limits have iterations to add and the residual may not pass, the splitting goes
  /// on for longer, unless it diverges, and then starts anew from no impulses, for longer still; what it does not solve
  /// is solved point by point.
  SolveResult solve(SolveLimits limits, const StepTerms& terms, double step, IslandReport& report);

  /// Solves what is prepared, within these limits.
  SolveResult solve_once(const SolveLimits& limits, IslandReport& report);

  /// Solves what is prepared point by point, from where it is.
  SolveResult solve_by_points(const PointLimits& limits, IslandReport& report);

 private:
  std::unique_ptr<ContactSolver> solver_;
  GaussSeidel gauss_seidel_;
};

/// How a solve is made where the effective gravity has just changed: to the end, since the last step is no guess.
SolveLimits limits_after_reset(const Effort& effort);

/// How a solve is repeated, with other contacts or less friction, from where it has ended.
SolveLimits repeated_limits(SolveLimits limits, const IslandView& island);

}  // namespace holdfast::internal::native
