#include "core/native/solver/admm.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/native/solver/body_kernels.hpp"
#include "core/native/solver/contact_kernels.hpp"
#include "core/native/solver/equilibrium.hpp"
#include "core/native/solver/solved_problems.hpp"
#include "same_bits.hpp"

namespace admm_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

constexpr double kStep = 0.01;
constexpr double kWeight = 2.0 * 9.81 * kStep;  ///< of the block, as an impulse of the step, kg m/s

/// A block of 2 kg, 1 m x 1 m x 0.2 m, on a fixed floor, with a velocity; gravity has a part along x.
ContactProblem block_on_floor(double friction, const Vec3& velocity, double slope = 0.0) {
  ContactProblem problem;
  const Vec3 size(1, 1, 0.2);
  ProblemBody& body = problem.bodies.emplace_back();
  body.mass = 2.0;
  body.radius = 0.5 * size.norm();
  for (int k = 0; k < 3; ++k) body.inertia(k, k) = body.mass / 12.0 * (size.squaredNorm() - size[k] * size[k]);
  const Vec3 free = velocity + kStep * Vec3(slope * 9.81, 0, -9.81);
  problem.free_velocity = {{{free.x(), free.y(), free.z()}}};
  problem.velocity.resize(2);
  ContactConstraint& floor = problem.constraints.emplace_back();
  floor.a = 1;
  floor.b = 0;
  floor.count = 4;
  floor.friction = friction;
  floor.effective_mass = body.mass / 4.0;
  floor.directions = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    floor.arms.b[0][i] = i % 2 == 0 ? -0.5 : 0.5;
    floor.arms.b[1][i] = i / 2 == 0 ? -0.5 : 0.5;
    floor.arms.b[2][i] = -0.1;
  }
  problem.constraint_pair = {kNoPair};
  problem.normal_bounds = {{{10, 10, 10, 10}}};
  problem.impulse_per_mass = 9.81 * kStep;
  return problem;
}

const SolveLimits kExact{.tolerance = 1e-13, .iterations = 2000};

SolveResult solve(ContactProblem& problem, const SolveLimits& limits = kExact) {
  AdmmSolver solver;
  return solver.solve(problem, limits);
}

double sum(const Lanes& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

/// How far a solution is from the laws of contact: the worst of the momentum balance, and, of every point, of the
/// normal and the tangential law; m/s.
double violation(const ContactProblem& problem) {
  const std::vector<BodyVector> left = missing_momentum(problem);
  double worst = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const ProblemBody& body = problem.bodies[i];
    worst = std::max({worst, linear(left[i]).cwiseAbs().maxCoeff() / body.mass,
                      angular(left[i]).cwiseAbs().maxCoeff() / (body.mass * body.radius)});
  }
  std::vector<ConstraintVector> u(problem.constraints.size()), g = u, r = u;
  relax(problem.constraints, problem.velocity, u, g, r);
  for (std::size_t p = 0; p < problem.constraints.size(); ++p) {
    const ContactConstraint& constraint = problem.constraints[p];
    for (std::size_t i = 0; i < static_cast<std::size_t>(constraint.count); ++i) {
      const double normal = constraint.impulse.row[0][i];
      const Vec3 velocity(u[p].row[0][i], u[p].row[1][i], u[p].row[2][i]);
      const Vec3 friction(0, constraint.impulse.row[1][i], constraint.impulse.row[2][i]);
      const double slip = std::hypot(velocity.y(), velocity.z());
      worst = std::max(worst, -velocity.x());
      if (normal > 0.0) worst = std::max(worst, std::abs(velocity.x()));
      // Where it slips, friction is at its limit and against the slip: the power is -mu y_n |u_t|.
      const double power = friction.dot(velocity) + constraint.friction * normal * slip;
      if (normal > 0.0)
        worst = std::max(worst, std::abs(power) / (constraint.effective_mass * problem.impulse_per_mass));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("admm: a block at rest is carried by its weight", "[core][admm]") {
  ContactProblem problem = block_on_floor(0.5, Vec3::Zero());
  const SolveResult result = solve(problem);
  CAPTURE(result.iterations, result.residual);
  CHECK(result.converged);
  CHECK(result.factorisations >= 1);
  for (const double v : problem.velocity[0].row) CHECK(std::abs(v) < 1e-12);
  CHECK(sum(problem.constraints[0].impulse.row[0]) == Approx(kWeight).epsilon(1e-10));
}

TEST_CASE("admm: a sliding block is braked by friction, a sticking one is held", "[core][admm]") {
  const double friction = 0.4;
  ContactProblem sliding = block_on_floor(friction, {0.9, -1.2, 0});
  CHECK(solve(sliding).converged);
  const double speed = std::hypot(sliding.velocity[0].row[0], sliding.velocity[0].row[1]);
  CHECK(speed == Approx(1.5 - friction * 9.81 * kStep).epsilon(1e-9));
  CHECK(sliding.velocity[0].row[0] / speed == Approx(0.6).epsilon(1e-9));
  CHECK(sum(sliding.constraints[0].impulse.row[1]) == Approx(-0.6 * friction * kWeight).epsilon(1e-9));

  ContactProblem held = block_on_floor(friction, Vec3::Zero(), 0.9 * friction);
  CHECK(solve(held).converged);
  CHECK(std::abs(held.velocity[0].row[0]) < 1e-12);
  CHECK(sum(held.constraints[0].impulse.row[1]) == Approx(-0.9 * friction * kWeight).epsilon(1e-9));
}

TEST_CASE("admm: a bias is the normal velocity that a contact ends with", "[core][admm]") {
  ContactProblem problem = block_on_floor(0.3, {0, 0, -2});
  problem.constraints[0].velocity_bias.row[0] = {-0.5, -0.5, -0.5, -0.5};
  CHECK(solve(problem).converged);
  CHECK(problem.velocity[0].row[2] == Approx(0.5).epsilon(1e-10));
}

TEST_CASE("admm: a block that separates has no impulse", "[core][admm]") {
  ContactProblem problem = block_on_floor(0.3, {0.1, 0, 2});
  CHECK(solve(problem).converged);
  CHECK(sum(problem.constraints[0].impulse.row[0]) == 0.0);
  CHECK(problem.velocity[0].row[2] == Approx(2 - 9.81 * kStep).epsilon(1e-12));
}

TEST_CASE("admm: the problems of a stack are solved to the laws of contact", "[core][admm]") {
  double worst = 0.0;
  int checked = 0;
  for (const SolvedProblem& kept : problems_of_a_stack()) {
    if (kept.given.limits.projection == Projection::orthogonal) continue;
    ContactProblem problem = kept.given.problem;
    SolveLimits limits = kept.given.limits;
    limits.tolerance = 1e-6;
    limits.iterations = 2000;
    limits.plain_iterations = 0;
    if (!solve(problem, limits).converged) continue;
    worst = std::max(worst, violation(problem) / limits.velocity_unit);
    ++checked;
  }
  CAPTURE(worst, checked);
  CHECK(checked > 30);
  CHECK(worst < 1e-4);
}

TEST_CASE("admm: a solve does not depend on what the solver solved before", "[core][admm]") {
  AdmmSolver used;
  for (const SolvedProblem& kept : problems_of_a_stack()) {
    ContactProblem problem = kept.given.problem;
    const SolveResult result = used.solve(problem, kept.given.limits);
    ContactProblem fresh = kept.given.problem;
    REQUIRE(solve(fresh, kept.given.limits).residual == result.residual);
    REQUIRE(same_bits(fresh.velocity, problem.velocity));
  }
}

TEST_CASE("admm: two solves of ten iterations are one of twenty, where R is not fitted in between", "[core][admm]") {
  SolveLimits limits{.tolerance = 0.0, .iterations = 20, .refit_every = 100, .refit_share = 1.0};
  ContactProblem whole = block_on_floor(0.4, {0.3, 0.1, -1}, 0.2);
  ContactProblem halves = whole;
  solve(whole, limits);
  AdmmSolver solver;
  limits.iterations = 10;
  solver.solve(halves, limits);
  CHECK(halves.continues);
  CHECK(solver.solve(halves, limits).factorisations == 0);
  CHECK(same_bits(whole.velocity, halves.velocity));
}

TEST_CASE("admm: the order of a renumbered problem is the identity", "[core][admm]") {
  for (const SolvedProblem& kept : problems_of_a_stack()) {
    AdmmSolver solver;
    const std::span<const std::uint32_t> order =
        solver.order(kept.given.problem.bodies.size(), kept.given.problem.pairs);
    for (std::size_t i = 0; i < order.size(); ++i) REQUIRE(order[i] == i);
  }
}

TEST_CASE("equilibrium: impulses that carry the weight balance a body, and none leave all of it",
          "[core][equilibrium]") {
  EquilibriumCheck check;
  ContactProblem problem = block_on_floor(0.5, Vec3::Zero());
  CHECK(check.residual(problem, 9.81 * kStep) == Approx(1.0));
  problem.constraints[0].impulse.row[0].fill(0.25 * kWeight);
  CHECK(check.residual(problem, 9.81 * kStep) < 1e-12);
  problem.constraints[0].impulse.row[0].fill(0.2 * kWeight);
  CHECK(check.residual(problem, 9.81 * kStep) == Approx(0.2));
}

TEST_CASE("equilibrium: impulses that are not numbers balance nothing", "[core][equilibrium]") {
  ContactProblem problem = block_on_floor(0.5, Vec3::Zero());
  problem.constraints[0].impulse.row[0].fill(0.25 * kWeight);
  problem.constraints[0].impulse.row[1][2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(EquilibriumCheck().residual(problem, 9.81 * kStep) <= 1e-6);
}

TEST_CASE("equilibrium: a slide refutes rest above the limit of friction, and not below", "[core][equilibrium]") {
  for (const double share : {0.5, 0.99, 1.01, 2.0}) {
    const double friction = 0.4;
    ContactProblem problem = block_on_floor(friction, Vec3::Zero(), share * friction);
    problem.velocity[0].row[0] = 1.0;
    // The motion with the least of friction: it lifts off as fast as it slips times mu, and works against gravity.
    problem.velocity[0].row[2] = friction;
    CAPTURE(share);
    CHECK(EquilibriumCheck().refutes_rest(problem, 100.0) == (share > 1.0));
  }
}

TEST_CASE("equilibrium: a spin refutes rest above the torque that friction holds, and not below",
          "[core][equilibrium]") {
  const double friction = 0.4;
  // Of four corners that carry the weight.
  const double held = friction * kWeight * std::hypot(0.5, 0.5);
  for (const double share : {-2.0, 0.5, 0.99, 1.01, 2.0}) {
    ContactProblem problem = block_on_floor(friction, Vec3::Zero());
    problem.free_velocity[0].row[padded_row(5)] = share * held / problem.bodies[0].inertia(2, 2);
    problem.velocity[0].row[padded_row(5)] = 1.0;
    // It lifts off as fast as the corners slip times mu.
    problem.velocity[0].row[2] = friction * std::hypot(0.5, 0.5);
    CAPTURE(share);
    CHECK(EquilibriumCheck().refutes_rest(problem, 100.0) == (share > 1.0));
  }
}

}  // namespace admm_test
