#include "core/native/island/impacts.hpp"

#include <catch2/catch.hpp>

#include "core/native/small_world.hpp"

namespace impacts_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using native_scenes::SmallWorld;

namespace {

constexpr double kStep = 0.004;  // s

/// A box that touches the floor and comes down on it; resolves the impact.
Vec3 velocity_after(double restitution, const Vec3& velocity, double friction = 0.0) {
  Settings settings = open_floor(friction);
  settings.contact.restitution = restitution;
  SmallWorld world(settings, layout_of({box({5, 5, 0}, {1, 1, 0.1})}));
  world.act(Vec3::Zero(), kStep);
  world.bodies().state.velocity[0] = velocity;
  IslandSolve solve(make_contact_solver());
  const SolvedMotion motion(solve.prepared);
  Impacts impacts(solve, motion);
  IslandReport report;
  const IslandView island = world.state.islands[0];
  const Effort& effort = world.options.effort(1);
  const ImpactTiming timing = impact_timing(world.bodies(), island, world.state.terms, effort, false, 0);
  impacts.resolve(world.state.scene, island, world.state.terms, effort, timing, kStep, report);
  return world.bodies().state.velocity[0];
}

}  // namespace

TEST_CASE("impacts: a flat box leaves the floor with e times its speed", "[core][impacts]") {
  CHECK(velocity_after(0.0, {0, 0, -2}).norm() < 1e-4);
  CHECK(velocity_after(0.5, {0, 0, -2}).z() == Approx(1.0).epsilon(1e-4));
  CHECK(velocity_after(0.0, {0, 0, 1}).z() == 1.0);  // it leaves: no impact
}

TEST_CASE("impacts: friction takes mu times the normal impulse from the slip", "[core][impacts]") {
  const Vec3 after = velocity_after(0.0, {3, 0, -2}, 0.4);
  CHECK(after.x() == Approx(3.0 - 0.4 * 2.0).epsilon(0.02));  // it also begins to turn, a little
  CHECK(velocity_after(0.0, {0.1, 0, -2}, 0.4).x() == Approx(0.0).margin(0.02));
}

TEST_CASE("impacts: those above a share of |g - a| h are located in time, as often as the step may be cut",
          "[core][impacts]") {
  SmallWorld world(open_floor(0.5), layout_of({box({5, 5, 0}, {1, 1, 0.1})}));
  world.act(Vec3::Zero(), kStep);
  const IslandView island = world.state.islands[0];
  Effort effort;
  effort.impact_cuts = 2;
  const double unit = kSmall * world.state.terms.velocity_unit;
  ImpactTiming timing = impact_timing(world.bodies(), island, world.state.terms, effort, false, 1);
  CHECK(timing.locates);
  CHECK(timing.located_speed == unit);
  CHECK_FALSE(impact_timing(world.bodies(), island, world.state.terms, effort, false, 2).locates);
  // A body that turns by w moves its corners by w^2 R h in the step: slower impacts may not be there.
  world.bodies().state.angular_velocity[0] = {0, 0, 3};
  timing = impact_timing(world.bodies(), island, world.state.terms, effort, false, 0);
  CHECK(timing.located_speed == Approx(kStep * 9.0 * world.bodies().radius[0]));
  CHECK(timing.filter(kStep).is_closed(0.9 * timing.located_speed * kStep));
  CHECK_FALSE(timing.filter(kStep).is_closed(1.1 * timing.located_speed * kStep));
  // In a crowd contacts count as closed that close by the slop.
  effort.slop = 5e-3;
  timing = impact_timing(world.bodies(), island, world.state.terms, effort, true, 0);
  CHECK(timing.locates);
  CHECK(timing.located_speed == effort.slop / kStep);
}

}  // namespace impacts_test
