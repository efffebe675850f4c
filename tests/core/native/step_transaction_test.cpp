#include "core/native/step_transaction.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <utility>

#include "core/native/small_world.hpp"

namespace step_transaction_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using native_scenes::SmallWorld;

namespace {

constexpr double kStep = 0.004;  // s

/// The engine's solver, of which some solves do not converge.
class FailingSolver final : public ContactSolver {
 public:
  /// @param fails whether this solve fails, by the time step that it is for, as |g - a| h, m/s
  explicit FailingSolver(std::function<bool(double)> fails) : fails_(std::move(fails)) {}

  std::span<const std::uint32_t> order(std::size_t count, std::span<const BodyPair> pairs) override {
    return solver_->order(count, pairs);
  }
  SolveResult solve(ContactProblem& problem, const SolveLimits& limits) override {
    SolveResult result = solver_->solve(problem, limits);
    if (problem.constraints.empty() || !fails_(limits.velocity_unit)) return result;
    // No other method solves it either.
    problem.free_velocity.front().row[0] = std::numeric_limits<double>::quiet_NaN();
    result.residual = 10.0 * limits.velocity_unit;
    return result;
  }

 private:
  std::function<bool(double)> fails_;
  std::unique_ptr<ContactSolver> solver_ = make_contact_solver();
};

/// Steps of a small world.
struct Steps {
  Counters counters;
  Status status = Status::ok;
  StepTransaction transaction;

  Steps(SmallWorld& world, IslandStepper& stepper)
      : transaction(world.state, stepper, world.options, counters, status) {}
};

}  // namespace

TEST_CASE("step: a box that falls freely goes as far as it should", "[core][step]") {
  SmallWorld world(open_floor(0.5), layout_of({box({5, 5, 2}, {1, 1, 1})}));
  Steps steps(world, world.stepper);
  world.act({1, 0, 0}, kStep);
  const Vec3 start = world.bodies().state.position[0];
  const Vec3 g = world.state.terms.effective_gravity;
  steps.transaction.take(kStep);
  CHECK(world.bodies().state.position[0].isApprox(start + 0.5 * kStep * kStep * g, 1e-12));
  CHECK(world.bodies().state.velocity[0].isApprox(kStep * g, 1e-12));
  CHECK(steps.status == Status::ok);
}

TEST_CASE("step: islands that meet in a step are solved together", "[core][step]") {
  // A fast box hits one that stands apart; what both have of momentum stays.
  SmallWorld world(open_floor(0.0), layout_of({box({5, 5, 0}, {1, 1, 1}), box({6.005, 5, 0}, {1, 1, 1})}));
  Steps steps(world, world.stepper);
  world.act({0, 0, 0}, kStep);
  world.bodies().state.velocity[0] = {2, 0, 0};
  world.state.find_contacts({1, 1});
  REQUIRE(world.state.islands.size() == 2);
  steps.transaction.take(kStep);
  CHECK(world.state.islands.size() == 1);
  const Vec3 sum = world.bodies().state.velocity[0] + world.bodies().state.velocity[1];
  CHECK(sum.isApprox(Vec3(2, 0, 0), 1e-6));
  const double gap = world.bodies().state.position[1].x() - world.bodies().state.position[0].x() - 1.0;
  CHECK(gap >= -1e-6);
}

TEST_CASE("step: an island whose solve fails takes the step in halves, the others stay", "[core][step]") {
  SmallWorld world(open_floor(0.5), layout_of({box({5, 5, 0}, {1, 1, 0.2}), box({10, 5, 2}, {1, 1, 1})}));
  world.act({8, 0, 0}, kStep);
  const double whole = world.state.terms.velocity_unit;
  int failures = 0;
  IslandStepper failing(world.options, std::make_unique<FailingSolver>([&](double unit) {
                          const bool fails = unit > 0.9 * whole;
                          failures += fails ? 1 : 0;
                          return fails;
                        }));
  Steps steps(world, failing);
  const std::vector<Vec3> start = world.bodies().state.position;
  const Vec3 g = world.state.terms.effective_gravity;
  steps.transaction.take(kStep);
  CHECK(failures > 0);
  CHECK(steps.status == Status::ok);
  CHECK(world.state.terms.step == kStep);
  // By implicit Euler, that is to where constant forces lead, and as much again over each half.
  const double sliding = g.x() + 0.5 * world.settings.gravity;
  CHECK((world.bodies().state.position[0] - start[0]).x() ==
        Approx((0.5 + 0.25) * kStep * kStep * sliding).epsilon(1e-4));
  CHECK(world.bodies().state.velocity[0].x() == Approx(kStep * sliding).epsilon(1e-4));
  CHECK(world.bodies().state.position[1].isApprox(start[1] + 0.5 * kStep * kStep * g, 1e-12));
  CHECK(world.bodies().activity == std::vector<Activity>{Activity::moving, Activity::moving});
}

TEST_CASE("step: a solve that never converges is said", "[core][step]") {
  SmallWorld world(open_floor(0.5), layout_of({box({5, 5, 0}, {1, 1, 0.2})}));
  world.act({8, 0, 0}, kStep);
  IslandStepper failing(world.options, std::make_unique<FailingSolver>([](double) { return true; }));
  Steps steps(world, failing);
  steps.transaction.take(kStep);
  CHECK(steps.status == Status::not_converged);
}

}  // namespace step_transaction_test
