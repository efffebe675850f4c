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
    if (!splitting
             .solve(by_splitting,
                    {.tolerance = 1e-7, .velocity_unit = unit, .iterations = 20000, .plain_iterations = 20000})
             .converged)
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

TEST_CASE("gauss_seidel: it converges where friction lifts what slides, however large it is", "[core][solve]") {
  // A box of 0.4 m x 2 m x 1.9 m has tilted on its lower edge, which slides forwards and downwards. With arm (x, z)
  // from the centre of mass to the edge, a unit impulse along the normal gives the edge 1/m + x²/I along the normal and
  // −x z/I forwards, and by symmetry an impulse backwards lifts it by as much, where x z > 0.
  const double mass = 100.0, x = -0.52, z = -0.82, inertia = mass * (0.4 * 0.4 + 1.9 * 1.9) / 12.0;
  const double forwards = 0.3, down = 0.05;
  for (const double friction : {0.5, 2.0, 6.0, 50.0}) {
    ContactProblem problem;
    problem.bodies = {{.mass = mass, .inertia = Mat3(Vec3(100.0, inertia, 100.0).asDiagonal()), .radius = 1.5}};
    problem.free_velocity = {body_vector(Vec3(forwards, 0, -down), Vec3::Zero())};
    problem.velocity.resize(2);
    ContactConstraint edge;
    edge.a = 1;
    edge.b = 0;
    edge.count = 2;
    edge.friction = friction;
    edge.directions = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
    for (std::size_t lane = 0; lane < 2; ++lane) {
      edge.arms.b[0][lane] = x;
      edge.arms.b[1][lane] = lane == 0 ? -1.0 : 1.0;
      edge.arms.b[2][lane] = z;
    }
    problem.constraints = {edge};
    const SolveResult result = GaussSeidel().solve(problem, {.tolerance = 1e-12});
    const double lifted = x * z / inertia;
    const double impulse = down / (1.0 / mass + x * x / inertia + friction * lifted);
    const double left = forwards - (friction * (1.0 / mass + z * z / inertia) + lifted) * impulse;
    CAPTURE(friction, result.iterations, left);
    CHECK(left > 0.0);  // it slides on
    CHECK(result.converged);
    CHECK(result.iterations < 200);
    for (std::size_t lane = 0; lane < 2; ++lane) {
      const ContactConstraint& solved = problem.constraints.front();
      CHECK(solved.impulse.row[0][lane] == Approx(0.5 * impulse));
      CHECK(solved.contact_velocity.row[0][lane] == Approx(0.0).margin(1e-11));
      CHECK(solved.contact_velocity.row[1][lane] == Approx(left));
    }
  }
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
