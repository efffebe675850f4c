#include "core/native/solver/admm.hpp"

#include <algorithm>
#include <cmath>

#include "core/native/solver/contact_kernels.hpp"

namespace holdfast::internal::native {

namespace {

/// The ratio rounded up to a power of 4, at least 1: scaling all masses by a power of 2 then scales R exactly.
double round_up_to_power_of_4(double ratio) {
  double power = 1.0;
  while (power < ratio) power *= 4.0;
  return power;
}

}  // namespace

std::unique_ptr<ContactSolver> make_contact_solver() { return std::make_unique<AdmmSolver>(); }

std::span<const std::uint32_t> AdmmSolver::order(std::size_t count, std::span<const BodyPair> pairs) {
  if (!ldlt_.analyse(count, pairs)) return ldlt_.elimination_indices();
  ordered_count_ = count;
  ordered_pairs_.clear();
  for (const auto& [a, b] : pairs) ordered_pairs_.emplace_back(ldlt_.elimination_index(a), ldlt_.elimination_index(b));
  return ldlt_.elimination_indices();
}

AdmmSolver::Penalty AdmmSolver::wanted_penalty(const ContactProblem& problem, const ContactConstraint& constraint,
                                               std::size_t lane, const SolveLimits& limits) const {
  const double normal = constraint.impulse.row[0][lane];
  const double expected = constraint.expected_impulse[lane];
  // Without friction nothing holds along the tangents: R would, until the solve has come to its end.
  const double held = constraint.friction > 0.0 ? 1.0 : 0.0;
  if (normal <= 0.0 && (problem.continues || expected <= 0.0)) {
    const double idle = limits.idle_penalty * constraint.effective_mass;
    return {limits.sticking * idle, held * limits.sliding * idle};
  }
  const double ratio = std::max(normal, expected) / (constraint.effective_mass * problem.impulse_per_mass);
  const double carried =
      constraint.effective_mass * round_up_to_power_of_4(std::min(heaviest_ / constraint.effective_mass, ratio));
  const double limit = kSlidingShare * constraint.friction * normal;
  const double tangential = constraint.impulse.row[1][lane] * constraint.impulse.row[1][lane] +
                            constraint.impulse.row[2][lane] * constraint.impulse.row[2][lane];
  const bool slides = normal > 0.0 && tangential >= limit * limit;
  return {limits.sticking * carried, held * (slides ? limits.sliding : limits.sticking) * carried};
}

/// Fits R to the impulses that are there. False where it stays, because few points call for another: they are not
/// worth a factorisation.
bool AdmmSolver::refit_penalty(ContactProblem& problem, const SolveLimits& limits) {
  // A point carries at most the whole island on a constraint's four: what is more is an impact's impulse, not mass.
  heaviest_ = 0.0;
  for (const ProblemBody& body : problem.bodies) heaviest_ += body.mass;
  heaviest_ /= static_cast<double>(kLanes);
  const auto for_each_point = [&](auto&& visit) {
    for (ContactConstraint& constraint : problem.constraints)
      for (std::size_t i = 0; i < static_cast<std::size_t>(constraint.count); ++i)
        visit(constraint, i, wanted_penalty(problem, constraint, i, limits));
  };
  if (problem.continues) {
    std::size_t points = 0;
    std::size_t others = 0;
    for_each_point([&](const ContactConstraint& constraint, std::size_t i, const Penalty& wanted) {
      ++points;
      if (wanted.normal != constraint.penalty[0][i] || wanted.tangential != constraint.penalty[1][i]) ++others;
    });
    if (static_cast<double>(others) <= limits.refit_share * static_cast<double>(points)) return false;
  }
  for_each_point([](ContactConstraint& constraint, std::size_t i, const Penalty& wanted) {
    constraint.penalty[0][i] = wanted.normal;
    constraint.penalty[1][i] = wanted.tangential;
    constraint.inverse_penalty[0][i] = 1.0 / wanted.normal;
    constraint.inverse_penalty[1][i] = wanted.tangential > 0.0 ? 1.0 / wanted.tangential : 0.0;
  });
  problem.continues = true;
  return true;
}

void AdmmSolver::factorise(const ContactProblem& problem) {
  ldlt_.clear();
  ldlt_.add(problem.bodies);
  ldlt_.add(problem.constraints, problem.mid_arms, problem.constraint_pair);
  ldlt_.factorise();
}

/// Adds the change to the velocities. Returns the largest change of the speed of any point, m/s.
double AdmmSolver::update_velocities(ContactProblem& problem) {
  double largest = 0.0;
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    double linear = 0.0, angular = 0.0;
    for (int k = 0; k < 3; ++k) {
      problem.velocity[i].row[k] += change_[i].row[k];
      problem.velocity[i].row[3 + k] += change_[i].row[3 + k];
      linear += change_[i].row[k] * change_[i].row[k];
      angular += change_[i].row[3 + k] * change_[i].row[3 + k];
    }
    const double change = std::sqrt(linear) + problem.bodies[i].radius * std::sqrt(angular);
    // Not std::max, which would lose what is not a number.
    if (!(change <= largest)) largest = change;
  }
  return largest;
}

SolveResult AdmmSolver::solve(ContactProblem& problem, const SolveLimits& limits) {
  // A problem that `order` was not asked for, such as one that was read from a file, is in its own order.
  if (problem.bodies.size() != ordered_count_ || problem.pairs != ordered_pairs_)
    order(problem.bodies.size(), problem.pairs);
  const double unit = limits.velocity_unit;
  const double tolerance = limits.tolerance * unit;
  SolveResult result;
  const std::size_t count = problem.constraints.size();
  u_.resize(count);
  g_.resize(count);
  r_.resize(count);
  std::size_t points = 0;
  for (const ContactConstraint& constraint : problem.constraints) points += static_cast<std::size_t>(constraint.count);
  PrimalResidual primal_residual;
  const auto may_pass = [&] {
    const double mean = limits.mean_residual * unit;
    return primal_residual.squares <= mean * mean * static_cast<double>(points) &&
           result.residual <= limits.worst_residual * unit;
  };
  const int most = limits.iterations + limits.more_iterations;
  while (!result.converged && result.iterations < (may_pass() ? limits.iterations : most)) {
    if (result.iterations % limits.refit_every == 0 && refit_penalty(problem, limits)) {
      factorise(problem);
      ++result.factorisations;
      anderson_.restart();
    }
    wrench_.assign(problem.bodies.size() + 1, LaneWrench{});
    if (limits.accelerate) {
      primal_residual = relax(problem.constraints, problem.velocity, limits.relaxation, u_, g_, r_);
      anderson_.accelerate(problem.constraints, g_, r_);
      project(limits.projection, problem.constraints, problem.mid_arms, g_, u_, problem.normal_bounds, wrench_);
    } else {
      primal_residual = relax_and_project(limits.projection, problem.constraints, problem.mid_arms, problem.velocity,
                                          limits.relaxation, problem.normal_bounds, wrench_);
    }
    momentum_residual(problem, wrench_, false, change_);
    ldlt_.solve(change_);
    const double largest_change = update_velocities(problem);
    ++result.iterations;
    result.residual = primal_residual.largest > largest_change ? primal_residual.largest : largest_change;
    result.converged = result.iterations >= kLeastIterations && result.residual <= tolerance;
  }
  return result;
}

}  // namespace holdfast::internal::native
