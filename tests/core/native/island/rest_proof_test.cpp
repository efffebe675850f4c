#include "core/native/island/rest_proof.hpp"

#include <catch2/catch.hpp>

#include "core/native/small_world.hpp"

namespace rest_proof_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using native_scenes::SmallWorld;

namespace {

constexpr double kFriction = 0.5;
constexpr double kStep = 0.004;  // s

bool rests(SmallWorld& world, double acceleration) {
  world.act({acceleration, 0, 0}, kStep);
  const IslandView island = world.state.islands[0];
  IslandReport report;
  return world.stepper.rest_proof().rests(world.state.scene, island,
                                          world.state.rest.terms_for(world.state.terms, island), false, report);
}

/// What a box does to a side at rest, N.
Vec3 force_on(const std::vector<SidePush>& pushes, std::string_view side) {
  Vec3 sum = Vec3::Zero();
  for (const SidePush& push : pushes)
    if (kPushedNames.at(push.side) == side) sum += push.impulse;
  return sum;
}

}  // namespace

TEST_CASE("rest proof: a box rests up to the limit of friction, and begins to slide by Coulomb's law", "[core][rest]") {
  SmallWorld world(open_floor(kFriction), layout_of({box({5, 5, 0}, {1, 1, 0.2})}));
  const double limit = kFriction * world.settings.gravity;
  CHECK(rests(world, 0.99999 * limit));
  CHECK_FALSE(rests(world, 1.00001 * limit));
  CHECK_FALSE(rests(world, 1.5 * limit));
  CHECK(world.bodies().last_step[0].acceleration.x() == Approx(-0.5 * limit).epsilon(1e-4));
  CHECK(world.bodies().last_step[0].angular_acceleration.norm() < 1e-4);
}

TEST_CASE("rest proof: a tower rests up to g l / h, and begins to turn about its edge", "[core][rest]") {
  const double length = 0.5, height = 2.0;
  SmallWorld world(open_floor(0.9), layout_of({box({5, 5, 0}, {length, 1, height})}));
  const double limit = world.settings.gravity * length / height;
  CHECK(rests(world, 0.99999 * limit));
  CHECK_FALSE(rests(world, 1.00001 * limit));
  CHECK_FALSE(rests(world, 1.5 * limit));
  // m (a h / 2 − g l / 2) = I α with I of the edge.
  const double inertia = (length * length + height * height) / 3.0;
  const double turning = 0.5 * (1.5 * limit * height - world.settings.gravity * length) / inertia;
  CHECK(world.bodies().last_step[0].angular_acceleration.y() == Approx(-turning).epsilon(1e-3));
}

TEST_CASE("rest proof: a wall gets the least that holds a box, and all sides together balance it", "[core][rest]") {
  Settings settings = open_floor(0.3);
  settings.screening.wall_forces = true;
  SmallWorld world(settings, layout_of({box({0, 5, 0}, {1, 1, 0.5})}));
  const double mass = world.bodies().mass[0];
  const double acceleration = 6.0;
  // The wall takes part once the box leans on it.
  Counters counters;
  world.act({acceleration, 0, 0}, kStep);
  world.state.rest.decide(world.state.scene, world.state.terms, world.state.islands, true, world.stepper.rest_proof(),
                          counters);
  REQUIRE(world.bodies().activity[0] == Activity::resting);
  const IslandView island = world.state.islands[0];
  world.stepper.rest_proof().find_resting_pushes(world.state.scene, island, world.state.terms);
  std::vector<SidePush> pushes;
  for (const SidePush& push : world.state.scene.side_forces.of_resting({})) pushes.push_back(push);
  // With mu N of its own the wall holds the box down on the floor: N + mu (m g + mu N) = m a.
  const double least = mass * (acceleration - 0.3 * settings.gravity) / (1.0 + 0.3 * 0.3);
  CHECK(force_on(pushes, "front").x() == Approx(-least).epsilon(1e-4));
  const Vec3 all = force_on(pushes, "front") + force_on(pushes, "floor");
  CHECK(all.isApprox(mass * world.state.terms.effective_gravity, 1e-6));
}

}  // namespace rest_proof_test
