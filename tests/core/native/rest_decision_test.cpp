#include "core/native/rest_decision.hpp"

#include <catch2/catch.hpp>

#include "core/native/constants.hpp"
#include "core/native/small_world.hpp"

namespace rest_decision_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using native_scenes::SmallWorld;

namespace {

constexpr double kFriction = 0.5;
constexpr double kStep = 0.004;  // s

/// A flat box that slides and does not tip, and one far from it.
Layout two_boxes() { return layout_of({box({5, 5, 0}, {1, 1, 0.2}), box({10, 5, 0}, {1, 1, 0.2})}); }

/// Decides which bodies rest; returns the iterations that it took.
std::uint64_t decide(SmallWorld& world) {
  Counters counters;
  world.state.rest.decide(world.state.scene, world.state.terms, world.state.islands, true, world.stepper.rest_proof(),
                          counters);
  return counters.solve_iterations;
}

}  // namespace

TEST_CASE("rest decision: a change of g - a is little beside what it was when it last changed by much",
          "[core][rest]") {
  SmallWorld world(open_floor(kFriction), two_boxes());
  CHECK(world.act({0, 0, 0}, kStep) == Change::none);
  CHECK(world.act({4, 0, 0}, kStep) == Change::much);
  CHECK(world.act({4, 0, 0}, kStep) == Change::none);
  const double little = 0.6 * kSmall * world.state.terms.effective_gravity.norm();
  CHECK(world.act({4 + little, 0, 0}, kStep) == Change::little);
  CHECK(world.act({4 + 2 * little, 0, 0}, kStep) == Change::much);
  CHECK(world.state.rest.note(world.bodies(), world.state.terms, world.state.terms.effective_gravity, true) ==
        Change::much);
}

TEST_CASE("rest decision: boxes rest below the limit of friction and move above it", "[core][rest]") {
  SmallWorld world(open_floor(kFriction), two_boxes());
  const double limit = kFriction * world.settings.gravity;
  for (const double share : {0.0, 0.999, 1.001, 1.5}) {
    CAPTURE(share);
    world.act({share * limit, 0, 0}, kStep);
    CHECK_FALSE(world.bodies().any(Activity::resting));
    decide(world);
    const Activity wanted = share < 1.0 ? Activity::resting : Activity::moving;
    CHECK(world.bodies().activity == std::vector<Activity>{wanted, wanted});
    // Those that move begin to slide backwards with what friction leaves over.
    const double sliding = share < 1.0 ? 0.0 : (1.0 - share) * limit;
    CHECK(world.bodies().last_step[0].acceleration.x() == Approx(sliding).margin(1e-5));
  }
}

TEST_CASE("rest decision: what rests is left alone, and what moves is tried again after a wait", "[core][rest]") {
  SmallWorld world(open_floor(kFriction), two_boxes());
  const double limit = kFriction * world.settings.gravity;
  world.act({0.5 * limit, 0, 0}, kStep);
  CHECK(decide(world) > 0);
  world.state.rest.end_step();
  CHECK(decide(world) == 0);
  world.act({1.5 * limit, 0, 0}, kStep);
  CHECK(decide(world) > 0);
  world.state.rest.end_step();
  CHECK(decide(world) == 0);  // it waits for a step
  world.state.rest.end_step();
  CHECK(decide(world) > 0);
}

TEST_CASE("rest decision: an island is reset where all of its bodies are", "[core][rest]") {
  SmallWorld world(open_floor(kFriction), two_boxes());
  world.act({1, 0, 0}, kStep);
  decide(world);
  CHECK(world.state.rest.terms_for(world.state.terms, world.state.islands[0]).reset_warm_start);
  CHECK_FALSE(world.state.rest.terms_for(world.state.terms, world.state.islands[0]).refuted);
  world.state.rest.end_step();
  CHECK_FALSE(world.state.rest.terms_for(world.state.terms, world.state.islands[0]).reset_warm_start);
  world.act({9, 0, 0}, kStep);
  decide(world);
  CHECK(world.state.rest.terms_for(world.state.terms, world.state.islands[0]).refuted);
}

TEST_CASE("rest decision: a box that leans on its neighbour joins its island", "[core][rest]") {
  // Slippery below, and pushed against one that holds: alone it would slide.
  Settings settings = open_floor(kFriction);
  settings.contact.friction_model = FrictionModel::product;
  settings.materials[2].friction = 0.0;
  Layout layout = layout_of({box({5, 5, 0}, {1, 1, 0.5}), box({6, 5, 0}, {0.5, 1, 0.5}, 2)});
  SmallWorld world(settings, layout);
  const double limit = world.on_floor(0)->friction * world.settings.gravity;
  REQUIRE(world.on_floor(1)->friction == 0.0);
  world.act({0.3 * limit, 0, 0}, kStep);  // pushes towards -x, against the first
  CHECK_FALSE(world.contact(0, 1)->active);
  decide(world);
  CHECK(world.contact(0, 1)->active);
  CHECK(world.state.islands.size() == 1);
  CHECK(world.bodies().activity == std::vector<Activity>{Activity::resting, Activity::resting});
}

}  // namespace rest_decision_test
