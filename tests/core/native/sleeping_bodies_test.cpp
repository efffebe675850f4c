#include "core/native/sleeping_bodies.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"

namespace sleeping_bodies_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native;
using namespace holdfast::internal::scenes;
using native_scenes::OneWorld;

namespace {

constexpr double kBraking = 3.0;   // m/s²
constexpr double kSlippery = 0.2;  // coefficient of friction of the slider on the plate

constexpr int kMany = 16;  ///< boxes that are, with what they stand on, an island in which bodies sleep

/// A plate with boxes on it, which are one island, far from the walls; material 2 is slippery.
Layout boxes_on_a_plate(int count) {
  Layout layout = layout_of({box({1, 1, 0}, {8, 4, 0.1})});
  for (int i = 0; i < count; ++i)
    layout.boxes.push_back(box({1.2 + 0.5 * (i % 10), 1.2 + 0.5 * (i / 10), 0.1}, {0.4, 0.4, 0.3}));
  Box slider = box({8.0, 3.0, 0.1}, {0.4, 0.4, 0.3});
  slider.material = 2;
  layout.boxes.push_back(slider);
  return layout;
}

Settings on_the_floor(double slippery, Accuracy accuracy = Accuracy::screening) {
  Settings settings = native_scenes::with(accuracy, open_floor(0.0));
  settings.contact.friction_model = FrictionModel::product;
  settings.materials[2].friction = slippery / settings.box_friction;
  return settings;
}

std::ptrdiff_t asleep(const OneWorld& scene) {
  const std::vector<Activity>& activity = scene.world.view().scene.bodies.activity;
  return std::count(activity.begin(), activity.end(), Activity::asleep);
}

/// Most bodies that sleep in any step.
std::ptrdiff_t most_asleep(OneWorld& scene) {
  std::ptrdiff_t most = 0;
  scene.run([&] { most = std::max(most, asleep(scene)); });
  return most;
}

}  // namespace

TEST_CASE("sleeping_bodies: while one box of a large island slides, the others sleep", "[core][sleeping_bodies]") {
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard}) {
    OneWorld scene(on_the_floor(kSlippery, accuracy), boxes_on_a_plate(kMany), constant(kBraking, 1.0));
    const StateColumns start = scene.batch.state;
    CHECK(most_asleep(scene) == kMany + 1);
    for (std::size_t i = 0; i < kMany + 1; ++i)
      CHECK((scene.batch.state.position[i] - start.position[i]).norm() < 1e-8);
    const double path = 0.5 * (kBraking - kSlippery * kGravity);
    CHECK(start.position[kMany + 1].x() - scene.batch.state.position[kMany + 1].x() == Approx(path).epsilon(1e-3));
  }
}

TEST_CASE("sleeping_bodies: not in islands of up to 16, not at reference, not where Sleep is off",
          "[core][sleeping_bodies]") {
  OneWorld small(on_the_floor(kSlippery), boxes_on_a_plate(14), constant(kBraking, 0.5));
  CHECK(most_asleep(small) == 0);
  OneWorld exact(on_the_floor(kSlippery, Accuracy::reference), boxes_on_a_plate(kMany), constant(kBraking, 0.05));
  CHECK(most_asleep(exact) == 0);
  Settings settings = on_the_floor(kSlippery);
  settings.native.sleep = false;
  OneWorld off(settings, boxes_on_a_plate(kMany), constant(kBraking, 0.5));
  CHECK(most_asleep(off) == 0);
}

TEST_CASE("sleeping_bodies: all are awake in every 32nd step, and where the acceleration changes",
          "[core][sleeping_bodies]") {
  const Acceleration acceleration = acceleration_of({{1.0, Vec3(kBraking, 0, 0)}, {1.0, Vec3(0, kBraking, 0)}});
  OneWorld scene(on_the_floor(kSlippery), boxes_on_a_plate(kMany), acceleration);
  std::vector<std::ptrdiff_t> counts;
  scene.run([&] { counts.push_back(asleep(scene)); });
  REQUIRE(counts.size() == 120);
  // In the first step of an acceleration no box counts as slow, in the second one it has to be, and in the next two
  // what carries it may still begin to sleep.
  for (std::size_t step = 0; step < counts.size(); ++step) {
    CAPTURE(step, counts[step]);
    if (step % 60 < 2 || step % 60 == 31)
      CHECK(counts[step] == 0);
    else if (step % 60 > 3)
      CHECK(counts[step] > 0);
  }
}

TEST_CASE("sleeping_bodies: boxes that an acceleration brings to slide little by little do not sleep through it",
          "[core][sleeping_bodies]") {
  // From 3 to 8 m/s² within a second, by less than 1 % per sample; boxes slide from 4.9 m/s² on.
  std::vector<std::pair<double, Vec3>> samples;
  for (int i = 0; i < 60; ++i) samples.emplace_back(1.0 / 60.0, Vec3(kBraking + 5.0 * i / 60.0, 0, 0));
  double path[2] = {};
  for (const bool sleep : {false, true}) {
    Settings settings = on_the_floor(kSlippery);
    settings.native.sleep = sleep;
    OneWorld scene(settings, boxes_on_a_plate(kMany), acceleration_of(samples));
    const StateColumns start = scene.batch.state;
    CHECK((most_asleep(scene) > 5) == sleep);
    path[sleep ? 1 : 0] = start.position[5].x() - scene.batch.state.position[5].x();
  }
  CHECK(path[0] > 0.15);
  CHECK(path[1] == Approx(path[0]).epsilon(0.01));
}

TEST_CASE("sleeping_bodies: none sleep where what begins to slide is as slow as rest", "[core][sleeping_bodies]") {
  // Just above the limit of friction: after a second the speed is still below that which may be rest.
  const double excess = 1e-3;  // m/s²
  OneWorld scene(on_the_floor((kBraking - excess) / kGravity), boxes_on_a_plate(kMany), constant(kBraking, 1.0));
  const StateColumns start = scene.batch.state;
  CHECK(most_asleep(scene) == 0);
  const double path = start.position[kMany + 1].x() - scene.batch.state.position[kMany + 1].x();
  CHECK(path == Approx(0.5 * excess).epsilon(0.05));
}

TEST_CASE("sleeping_bodies: what is hit wakes, and is pushed as it would be awake", "[core][sleeping_bodies]") {
  // The slider is heavy, and meets the light first box of another row after 0.4 m.
  double path[2] = {};
  for (const bool sleep : {false, true}) {
    Settings settings = on_the_floor(kSlippery);
    settings.native.sleep = sleep;
    settings.materials[2].density = 4000.0;
    Layout layout = boxes_on_a_plate(kMany);
    layout.boxes.push_back(box({7.4, 3.0, 0.1}, {0.2, 0.4, 0.3}));
    OneWorld scene(settings, layout, constant(kBraking, 1.5));
    const StateColumns start = scene.batch.state;
    CHECK((most_asleep(scene) > 0) == sleep);
    path[sleep ? 1 : 0] = start.position[kMany + 2].x() - scene.batch.state.position[kMany + 2].x();
  }
  CHECK(path[0] > 0.3);
  CHECK(path[1] == Approx(path[0]).epsilon(0.03));
}

TEST_CASE("sleeping_bodies: what a position correction separates is no contact of sleeping bodies",
          "[core][sleeping_bodies]") {
  // Shortly after the acceleration has ended, boxes sleep whose overlaps are put right at the start of the step.
  Settings settings;
  settings.native.accuracy = Accuracy::screening;
  OneWorld scene(settings, physics::bundled_layout("BR0_012_block", settings),
                 acceleration_of({{0.5, Vec3::Zero()}, {1.0, Vec3(-0.5 * kGravity, 0, 0)}, {0.5, Vec3::Zero()}}));
  std::ptrdiff_t most = 0;
  scene.run([&] {
    most = std::max(most, asleep(scene));
    const std::vector<std::string> broken = broken_invariants(scene.world.view());
    CAPTURE(broken.empty() ? "" : broken.front());
    REQUIRE(broken.empty());
  });
  CHECK(most > 10);
}

TEST_CASE("sleeping_bodies: a box falls where what it lies on is drawn away from under it", "[core][sleeping_bodies]") {
  // The lid is held by two stops, between which the drawer slides away.
  for (const double drawn : {0.0, 0.05, 0.1, 0.15, 0.2}) {
    std::size_t falls_at[2] = {};
    for (const bool sleep : {false, true}) {
      Settings settings = on_the_floor(0.02);
      settings.native.sleep = sleep;
      Layout layout = boxes_on_a_plate(kMany);
      layout.boxes.back() = box({6.0 - drawn, 3.0, 0.1}, {0.6, 0.4, 0.3});
      layout.boxes.back().material = 2;
      const std::size_t lid = layout.boxes.size();
      layout.boxes.push_back(box({6.1, 2.7, 0.4}, {0.4, 1.0, 0.3}));
      layout.boxes.push_back(box({5.6, 2.4, 0.1}, {0.5, 0.5, 0.7}));
      layout.boxes.push_back(box({5.6, 3.5, 0.1}, {0.5, 0.5, 0.7}));
      OneWorld scene(settings, layout, constant(kBraking, 1.5));
      const double height = scene.batch.state.position[lid].z();
      const Bodies& bodies = scene.world.view().scene.bodies;
      const auto body = std::find(bodies.world_box.begin(), bodies.world_box.end(), lid) - bodies.world_box.begin();
      std::size_t step = 0;
      std::ptrdiff_t most = 0;
      scene.run([&] {
        ++step;
        most = std::max(most, asleep(scene));
        const Vec3& now = bodies.state.position[static_cast<std::size_t>(body)];
        if (falls_at[sleep ? 1 : 0] == 0 && now.z() < height - 0.1) falls_at[sleep ? 1 : 0] = step;
      });
      CHECK((most > 10) == sleep);
    }
    CAPTURE(drawn, falls_at[0], falls_at[1]);
    CHECK(falls_at[0] > 30);
    CHECK(falls_at[1] >= falls_at[0] - 1);
    CHECK(falls_at[1] <= falls_at[0] + 1);
  }
}

}  // namespace sleeping_bodies_test
