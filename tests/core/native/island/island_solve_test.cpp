#include "core/native/island/island_solve.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace island_solve_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;

namespace {

/// With what a solver is asked to solve.
struct Asked {
  SolveLimits limits;
  double impulse = 0.0;  ///< along the normal, of the first point, N s
};

/// Writes down with what it is asked to solve, and ends with the residuals that it is told.
class ScriptedSolver final : public ContactSolver {
 public:
  ScriptedSolver(std::vector<Asked>& asked, std::vector<double> residuals)
      : asked_(asked), residuals_(std::move(residuals)) {}

  std::span<const std::uint32_t> order(std::size_t, std::span<const BodyPair>) override { return {}; }
  SolveResult solve(ContactProblem& problem, const SolveLimits& limits) override {
    asked_.push_back({limits, problem.constraints.empty() ? 0.0 : problem.constraints[0].impulse.row[0][0]});
    return {.iterations = 7, .residual = residuals_.at(asked_.size() - 1) * limits.velocity_unit};
  }

 private:
  std::vector<Asked>& asked_;
  std::vector<double> residuals_;
};

/// All solves that it takes.
std::vector<Asked> solves(const std::vector<double>& residuals) {
  std::vector<Asked> asked;
  IslandSolve solve(std::make_unique<ScriptedSolver>(asked, residuals));
  StepTerms terms;
  terms.effective_gravity = {0, 0, -10};
  SolveLimits limits;
  limits.iterations = 20;
  limits.more_iterations = 40;
  limits.worst_residual = 0.1;
  limits.plain_iterations = 0;
  IslandReport report;
  solve.solve(limits, terms, 0.01, report);
  // One sweep over no points.
  const bool is_swept = !(residuals.at(asked.size() - 1) <= kWorstResidual);
  CHECK(report.iterations == 7 * asked.size() + (is_swept ? 1 : 0));
  for (const Asked& each : asked) CHECK(each.limits.velocity_unit == Approx(0.1));
  return asked;
}

}  // namespace

TEST_CASE("island solve: what may pass is solved once, what may not goes on for longer", "[core][solve]") {
  CHECK(solves({0.05}).size() == 1);
  const std::vector<Asked> asked = solves({0.2, 0.05});
  REQUIRE(asked.size() == 2);
  CHECK(asked[1].limits.more_iterations == kMoreIterations * 60);
  CHECK(asked[1].limits.plain_iterations == kPlainIterations);
}

TEST_CASE("island solve: a splitting that diverges starts anew, and so does one that goes on in vain",
          "[core][solve]") {
  CHECK(solves({2.0 * kLarge, 0.2}).size() == 2);
  CHECK(solves({std::numeric_limits<double>::quiet_NaN(), 0.2}).size() == 2);
  CHECK(solves({2.0 * kLarge, 2.0 * kLarge}).size() == 2);
  const std::vector<Asked> asked = solves({1.0, 1.0, 0.2});
  REQUIRE(asked.size() == 3);
  CHECK(asked[2].limits.more_iterations == kMoreIterations * (20 + asked[1].limits.more_iterations));
}

// A block of 2 kg that slides at 3 m/s over a floor: friction takes μ g h, and the floor carries the weight.
TEST_CASE("island solve: the step that the splitting does not solve is solved point by point", "[core][solve]") {
  constexpr double kStep = 0.01, kFriction = 0.5;
  std::vector<Asked> asked;
  IslandSolve solve(std::make_unique<ScriptedSolver>(asked, std::vector<double>{1.0, 1.0, 1.0}));
  ContactProblem& problem = solve.prepared.problem;
  problem.bodies = {{.mass = 2.0, .inertia = Mat3::Identity(), .radius = 0.7}};
  problem.free_velocity = {{{3.0, 0, -10.0 * kStep}}};
  problem.velocity.resize(2);
  ContactConstraint& floor = problem.constraints.emplace_back();
  floor.a = 1;
  floor.count = 4;
  floor.friction = kFriction;
  floor.directions = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    floor.arms.b[0][i] = i % 2 == 0 ? -0.5 : 0.5;
    floor.arms.b[1][i] = i / 2 == 0 ? -0.5 : 0.5;
    floor.impulse.row[0][i] = 7.0;
  }
  StepTerms terms;
  terms.effective_gravity = {0, 0, -10};
  SolveLimits limits;
  // A proof of rest has no iterations to add: its bounds are not those of a step.
  limits.more_iterations = GENERATE(0, 1);
  IslandReport report;
  const SolveResult result = solve.solve(limits, terms, kStep, report);
  if (limits.more_iterations == 0) {
    CHECK(asked.size() == 1);
    CHECK(result.residual == Approx(10.0 * kStep));
    return;
  }
  REQUIRE(asked.size() == 3);
  CHECK(asked[1].impulse == 7.0);
  CHECK(asked[2].impulse == 0.0);
  CHECK(report.iterations == 21 + static_cast<std::uint64_t>(result.iterations));
  constexpr double near = kNoticeable * 10.0 * kStep;  // m/s
  CHECK(result.residual <= near);
  CHECK(problem.velocity[0].row[0] == Approx(3.0 - kFriction * 10.0 * kStep).margin(near));
  CHECK(problem.velocity[0].row[2] == Approx(0.0).margin(near));
}

TEST_CASE("island solve: only large islands repeat a solve with fewer iterations", "[core][solve]") {
  SolveLimits limits;
  limits.iterations = 20;
  std::vector<std::uint32_t> bodies(kSmallIslandBodies);
  CHECK(repeated_limits(limits, {bodies, {}}).iterations == 20);
  bodies.push_back(0);
  CHECK(repeated_limits(limits, {bodies, {}}).iterations == static_cast<int>(20 * kRepeatedShare));
  limits.iterations = 1;
  CHECK(repeated_limits(limits, {bodies, {}}).iterations == kLeastIterations);
}

}  // namespace island_solve_test
