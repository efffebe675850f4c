#include "solver_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/vector.hpp"
#include "core/native/solver/admm.hpp"
#include "core/reference/plain_solver.hpp"

namespace holdfast::internal::native {

namespace {

/// Where both methods end at the latest, in units of what gravity and acceleration add to a velocity in the step.
constexpr double kConverged = 1e-6;

/// Sweeps of the plain method for each iteration of the splitting, which is that much dearer.
constexpr std::uint64_t kSweepsPerIteration = 20;

Vec3 lane_of(const std::array<Lanes, 3>& arms, std::size_t lane) {
  return {arms[0].at(lane), arms[1].at(lane), arms[2].at(lane)};
}

ContactProblem simplified(const ContactProblem& problem) {
  ContactProblem simple = problem;
  simple.mid_arms.clear();
  for (ContactConstraint& constraint : simple.constraints)
    for (std::size_t d = 1; d < 3; ++d) constraint.velocity_bias.row.at(d).fill(0.0);
  simple.reset_warm_start();
  return simple;
}

std::vector<plain::Mover> movers_of(const ContactProblem& problem) {
  std::vector<plain::Mover> movers(problem.bodies.size() + 1);
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    const BodyVector& v = problem.free_velocity[i];
    movers[i] = {.inverse_mass = 1.0 / problem.bodies[i].mass,
                 .inverse_inertia = problem.bodies[i].inertia.inverse(),
                 .velocity = linear(v),
                 .angular_velocity = angular(v)};
  }
  return movers;
}

std::vector<plain::PointLaw> laws_of(const ContactProblem& problem) {
  std::vector<plain::PointLaw> laws;
  for (const ContactConstraint& constraint : problem.constraints) {
    const native::Direction& normal = constraint.directions[0];
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(constraint.count); ++lane)
      laws.push_back({.a = static_cast<std::size_t>(constraint.a),
                      .b = static_cast<std::size_t>(constraint.b),
                      .arm_a = lane_of(constraint.arms.a, lane),
                      .arm_b = lane_of(constraint.arms.b, lane),
                      .normal = {normal[0], normal[1], normal[2]},
                      .least = -constraint.velocity_bias.row[0].at(lane),
                      .friction = constraint.friction});
  }
  return laws;
}

}  // namespace

VelocityDifference velocity_difference(const ContactProblem& found, const ContactProblem& other) {
  VelocityDifference difference;
  ContactProblem between = found;
  for (std::size_t i = 0; i < found.bodies.size(); ++i) {
    for (int row = 0; row < kPaddedRows; ++row) between.velocity[i].row[row] -= other.velocity[i].row[row];
    const double speed = largest_speed(between, i);
    difference.worst = std::max(difference.worst, speed);
    difference.mean += speed * speed;
  }
  difference.mean = std::sqrt(difference.mean / static_cast<double>(std::max<std::size_t>(1, found.bodies.size())));
  return difference;
}

LongSolve solve_for_long(const ContactProblem& problem, const SolveLimits& limits, int iterations) {
  LongSolve solve{problem, {}};
  SolveLimits longer = limits;
  longer.tolerance = kConverged;
  longer.iterations = iterations;
  longer.more_iterations = 0;
  longer.mean_residual = 0.0;
  longer.worst_residual = 0.0;
  AdmmSolver solver;
  solver.order(solve.problem.bodies.size(), solve.problem.pairs);
  solve.result = solver.solve(solve.problem, longer);
  return solve;
}

std::optional<VelocityDifference> method_difference(const ContactProblem& problem, const SolveLimits& limits,
                                                    int iterations) {
  if (!problem.normal_bounds.empty()) return std::nullopt;
  const LongSolve splitting = solve_for_long(simplified(problem), limits, iterations);
  std::vector<plain::Mover> movers = movers_of(problem);
  const double tolerance = kConverged * limits.velocity_unit;
  plain::solve(movers, laws_of(problem), tolerance, kSweepsPerIteration * static_cast<std::uint64_t>(iterations));
  ContactProblem other = splitting.problem;
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      other.velocity[i].row[axis] = movers[i].velocity[axis];
      other.velocity[i].row[kAngularRow + axis] = movers[i].angular_velocity[axis];
    }
  }
  return velocity_difference(splitting.problem, other);
}

}  // namespace holdfast::internal::native
