#include "core/native/solver/admm.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/solver/body_kernels.hpp"
#include "core/native/solver/contact_kernels.hpp"
#include "core/native/solver/penalty_kernels.hpp"

namespace holdfast::internal::native {

std::unique_ptr<ContactSolver> make_contact_solver() { return std::make_unique<AdmmSolver>(); }

std::span<const std::uint32_t> AdmmSolver::order(std::size_t count, std::span<const BodyPair> pairs) {
  if (!ldlt_.analyse(count, pairs)) return ldlt_.elimination_indices();
  ordered_count_ = count;
  ordered_pairs_.clear();
  for (const auto& [a, b] : pairs) ordered_pairs_.emplace_back(ldlt_.elimination_index(a), ldlt_.elimination_index(b));
  return ldlt_.elimination_indices();
}

/// Fits R to the impulses that are there. False where it stays, because few points call for another: they are not
/// worth a factorisation.
bool AdmmSolver::refit_penalty(ContactProblem& problem, const SolveLimits& limits, std::size_t points) {
  PenaltyFit fit{.sticking = limits.sticking,
                 .sliding = limits.sliding,
                 .idle = limits.idle_penalty,
                 .impulse_per_mass = problem.impulse_per_mass,
                 .continues = problem.continues};
  // A point carries at most the whole island on a constraint's four: what is more is an impact's impulse, not mass.
  fit.heaviest = problem.mass() / static_cast<double>(kLanes);
  if (problem.continues) {
    const double others = count_misfits(fit, problem.constraints);
    if (others <= limits.refit_share * static_cast<double>(points)) return false;
  }
  fit_penalty(fit, problem.constraints);
  problem.continues = true;
  return true;
}

void AdmmSolver::factorise(const ContactProblem& problem) {
  ldlt_.clear();
  ldlt_.add(problem.bodies);
  ldlt_.add(problem.constraints, problem.mid_arms, problem.constraint_pair);
  ldlt_.factorise();
}

SolveResult AdmmSolver::solve(ContactProblem& problem, const SolveLimits& limits) {
  // A problem that `order` was not asked for, such as one that was read from a file, is in its own order.
  if (problem.bodies.size() != ordered_count_ || problem.pairs != ordered_pairs_)
    order(problem.bodies.size(), problem.pairs);
  const double unit = limits.velocity_unit;
  const double tolerance = limits.tolerance * unit;
  SolveResult result;
  for (std::vector<ConstraintVector>* const of_constraints : {&u_, &g_, &r_})
    of_constraints->resize(problem.constraints.size());
  std::size_t points = 0;
  for (const ContactConstraint& constraint : problem.constraints) points += static_cast<std::size_t>(constraint.count);
  PrimalResidual primal_residual;
  const auto may_pass = [&] {
    const double mean = limits.mean_residual * unit;
    return primal_residual.squares <= mean * mean * static_cast<double>(points) &&
           result.residual <= limits.worst_residual * unit;
  };
  const int most = limits.iterations + limits.more_iterations;
  const double largest_impulse = kAndersonImpulse * problem.mass() * problem.impulse_per_mass;
  while (!result.converged && result.iterations < (may_pass() ? limits.iterations : most)) {
    if (result.iterations % limits.refit_every == 0 && refit_penalty(problem, limits, points)) {
      factorise(problem);
      ++result.factorisations;
      anderson_.restart();
    }
    wrench_.assign(problem.bodies.size() + 1, LaneWrench{});
    if (result.iterations >= limits.plain_iterations) {
      // A solve that is accelerated from the start may go on from the one before it.
      if (result.iterations == limits.plain_iterations && limits.plain_iterations > 0) anderson_.restart();
      primal_residual = relax(problem.constraints, problem.velocity, u_, g_, r_);
      anderson_.accelerate(problem.constraints, largest_impulse, g_, r_);
      project(limits.projection, problem.constraints, problem.mid_arms, g_, u_, problem.normal_bounds, wrench_);
    } else {
      primal_residual = relax_and_project(limits.projection, problem.constraints, problem.mid_arms, problem.velocity,
                                          problem.normal_bounds, wrench_);
    }
    change_.resize(problem.bodies.size());
    momentum_residual(problem.bodies, problem.free_velocity, problem.velocity.data(), wrench_, change_);
    ldlt_.solve(change_);
    const double largest_change = add_velocity_changes(problem.bodies, change_, problem.velocity);
    ++result.iterations;
    result.residual = primal_residual.largest > largest_change ? primal_residual.largest : largest_change;
    result.converged = result.iterations >= kLeastIterations && result.residual <= tolerance;
  }
  return result;
}

}  // namespace holdfast::internal::native
