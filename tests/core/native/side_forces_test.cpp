#include "core/native/side_forces.hpp"

#include <catch2/catch.hpp>

#include "core/native/small_world.hpp"

namespace side_forces_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using native_scenes::SmallWorld;

namespace {

Vec3 impulse_on(const SideForces& forces, std::size_t side) { return forces.sum().at(side).impulse; }

}  // namespace

TEST_CASE("side forces: what moving bodies do counts when the step is accepted", "[core][walls]") {
  SideForces forces(true);
  forces.begin_sum();
  forces.of_step() = {
      {0, 1, {1, 0, 0}, Vec3::Zero()}, {1, 1, {2, 0, 0}, Vec3::Zero()}, {1, 2, {0, 4, 0}, Vec3::Zero()}};
  CHECK(impulse_on(forces, 1) == Vec3::Zero());
  forces.forget({1, 0});
  forces.accept_step();
  CHECK(impulse_on(forces, 1) == Vec3(2, 0, 0));
  CHECK(impulse_on(forces, 2) == Vec3(0, 4, 0));
  const SideImpulses before = forces.sum();
  forces.accept_step();
  CHECK(impulse_on(forces, 1) == Vec3(4, 0, 0));
  forces.set_sum(before);
  CHECK(impulse_on(forces, 1) == Vec3(2, 0, 0));
}

TEST_CASE("side forces: bodies at rest press for as long as they rest, with their weight", "[core][walls]") {
  Settings settings = open_floor(0.5);
  settings.screening.wall_forces = true;
  SmallWorld world(settings, layout_of({box({5, 5, 0}, {1, 1, 1}), box({8, 5, 0}, {1, 1, 1})}));
  SideForces& forces = world.state.scene.side_forces;
  REQUIRE(forces.wanted());
  Counters counters;
  world.state.rest.decide(world.state.scene, world.state.terms, world.state.islands, true, world.stepper.rest_proof(),
                          counters);
  const std::size_t floor = floor_of(world.state.scene)->index;
  const double weight = world.bodies().mass[0] * world.settings.gravity;
  const auto press = [&] {
    forces.begin_sum();
    world.state.rest.add_pushes(world.state.scene, world.state.terms, 2.0, world.stepper.rest_proof());
  };
  press();
  CHECK(impulse_on(forces, floor).z() == Approx(-2.0 * 2.0 * weight).epsilon(1e-7));
  world.bodies().activity[1] = Activity::moving;
  press();
  CHECK(impulse_on(forces, floor).z() == Approx(-2.0 * weight).epsilon(1e-7));
}

TEST_CASE("side forces: what sleeping bodies do and what is left over balances their weight", "[core][walls]") {
  SmallWorld world(open_floor(0.5), layout_of({box({5, 5, 0}, {1, 1, 1})}));
  world.bodies().activity[0] = Activity::asleep;
  const double weight = world.bodies().mass[0] * world.settings.gravity;
  for (CachedImpulse& cached : world.on_floor(0)->cached) cached.force = {0, 0, 0.2 * weight};  // four points: 0.8
  SideForces& forces = world.state.scene.side_forces;
  const std::size_t floor = floor_of(world.state.scene)->index;
  forces.begin_sum();
  forces.add_sleeping(world.state.scene, world.state.terms, 0.5);
  CHECK(impulse_on(forces, floor).isApprox(Vec3(0, 0, -0.5 * weight), 1e-12));
  forces = SideForces(true);
  world.bodies().state.velocity[0] = Vec3(0.25, 0, 0);
  world.bodies().last_step[0].missing_velocity = Vec3(0, 0.125, 0);
  forces.add_stopped(world.state.scene, 0);
  CHECK(impulse_on(forces, floor).isApprox(Vec3(0.25, 0.125, 0) * world.bodies().mass[0], 1e-12));
}

}  // namespace side_forces_test
