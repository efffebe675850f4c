#include "core/native/solver/gauss_seidel.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/native/solver/admm.hpp"
#include "core/native/solver/solved_problems.hpp"

namespace gauss_seidel_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

constexpr std::size_t kManyVisits = 100'000'000;

double largest_difference(const ContactProblem& a, const ContactProblem& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.bodies.size(); ++i)
    for (int k = 0; k < kPaddedRows; ++k)
      largest = std::max(largest, std::abs(a.velocity[i].row[k] - b.velocity[i].row[k]));
  return largest;
}

/// Largest momentum of a body that its impulses do not account for, kg m/s.
double largest_missing_momentum(const ContactProblem& problem) {
  double largest = 0.0;
  for (const BodyVector& body : missing_momentum(problem))
    for (const double entry : body.row) largest = std::max(largest, std::abs(entry));
  return largest;
}

}  // namespace

TEST_CASE("gauss_seidel: it finds the velocities that the splitting finds", "[core][solve]") {
  std::size_t sliding = 0, turning = 0;
  for (const SolvedProblem& problem : problems_of_a_stack()) {
    if (problem.given.limits.projection != Projection::coulomb || !problem.given.problem.normal_bounds.empty())
      continue;
    const double unit = problem.given.limits.velocity_unit;
    ContactProblem by_splitting = problem.given.problem;
    AdmmSolver splitting;
    if (!splitting.solve(by_splitting, {.tolerance = 1e-7, .velocity_unit = unit, .iterations = 20000}).converged)
      continue;
    ++(problem.given.problem.mid_arms.empty() ? sliding : turning);
    ContactProblem by_points = problem.given.problem;
    const SolveResult result = GaussSeidel().solve(by_points, {.tolerance = 1e-6 * unit, .visits = kManyVisits});
    CHECK(result.converged);
    CHECK(result.residual <= 1e-6 * unit);
    CHECK(largest_difference(by_points, by_splitting) < kSmall * unit);
    CHECK(impulses_are_in_cones(by_points));
    CHECK(largest_missing_momentum(by_points) < 1e-9);
  }
  CHECK(sliding > 0);
  CHECK(turning > 3);
}

TEST_CASE("gauss_seidel: sweeps that do not suffice are said, and what is no number", "[core][solve]") {
  const std::vector<SolvedProblem> problems = problems_of_a_stack();
  ContactProblem problem = problems.back().given.problem;
  std::size_t points = 0;
  for (const ContactConstraint& constraint : problem.constraints) points += static_cast<std::size_t>(constraint.count);
  const SolveResult short_of = GaussSeidel().solve(problem, {.visits = 3 * points, .more_visits = 0});
  CHECK(short_of.iterations == 3);
  CHECK_FALSE(short_of.converged);
  CHECK(impulses_are_in_cones(problem));
  CHECK(largest_missing_momentum(problem) < 1e-9);
  problem.free_velocity.front().row[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(GaussSeidel().solve(problem, {.tolerance = 1.0, .visits = 3 * points, .more_visits = 0}).residual ==
        std::numeric_limits<double>::infinity());
}

}  // namespace gauss_seidel_test
