// Forces of the boxes on the sides of the container, against statics and against the balance of momentum.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "analyses/walls/wall_forces.hpp"
#include "core/native/native_scenes.hpp"
#include "physics/measures.hpp"

namespace wall_forces_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native_scenes;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

constexpr std::size_t kFloor = 0;
constexpr std::size_t kFront = 1;
constexpr std::initializer_list<Accuracy> kAll = {Accuracy::screening, Accuracy::standard, Accuracy::reference};

Settings measured(Settings settings) {
  settings.screening.wall_forces = true;
  return settings;
}

/// Boxes of 1 m x 1.2 m x 0.4 m in a row along x, at a distance from the front wall, m.
Layout row(int count, double gap) {
  Layout layout = layout_of({});
  for (int i = 0; i < count; ++i) layout.boxes.push_back(box({i + gap, 5, 0}, {1.0, 1.2, 0.4}));
  return layout;
}
constexpr double kMass = 250.0 * 1.0 * 1.2 * 0.4;  ///< of such a box, kg

/// What was found; the run was asked for it.
const WallForces& walls(const Run& run) { return *run.record.found.get<WallForces>(); }

/// Force on a side at the last sample, N.
double last_force(const Run& run, std::size_t side) { return walls(run).force.back().at(side); }

}  // namespace

TEST_CASE("wall_forces: a box that jams under a roof presses with no more than a few times its weight",
          "[physics][walls]") {
  // It tips against a drop side, or a fixed box, until it touches the roof: friction could hold any force between
  // these.
  for (const Accuracy accuracy : kAll) {
    for (const bool fixed : {false, true}) {
      Settings settings = measured(with(accuracy, small_container(accuracy)));
      settings.container.size = {1.2, 2.8, 2.0};
      settings.contact.friction_model = FrictionModel::pairs;
      settings.contact.box_floor = 0.2;
      settings.contact.box_wall = settings.contact.box_box = 0.5;
      Layout layout = layout_of({box({0.1, fixed ? 0.4 : 0.1, 0}, {1.0, 0.6, fixed ? 1.98 : 1.999})});
      const double mass = 100.0;
      layout.boxes[0].mass = mass;
      if (fixed) {
        layout.boxes.push_back(box({0.1, 0, 0}, {1.0, 0.3, 0.4}));
        layout.boxes[1].fixed = true;
      } else {
        settings.container.drop_sides = {{"left", 0.2}};
        settings.container.bed_height = 0.15;
      }
      const Acceleration push =
          acceleration_of({{0.5, Vec3::Zero()}, {1.0, Vec3(0, 0.5 * kGravity, 0)}, {1.0, Vec3::Zero()}});
      const Run run = native_run(layout, push, settings);
      const auto& lasting = walls(run).lasting_force;
      CAPTURE(static_cast<int>(accuracy), fixed);
      CHECK(*std::max_element(lasting.begin(), lasting.end()) < 5.0 * mass * kGravity);
    }
  }
}

TEST_CASE("wall_forces: a row that is braked presses the front wall with m k (a - mu g)", "[physics][walls]") {
  for (const Accuracy accuracy : kAll) {
    for (const auto& [count, gap] : {std::pair(1, 0.0), {3, 0.01}, {8, 0.0}}) {
      for (const auto& [friction, acceleration] : {std::pair(0.3, 5.0), std::pair(0.3, 8.0), std::pair(0.5, 9.81)}) {
        Settings settings = measured(with(accuracy, open_floor(friction)));
        settings.contact.box_wall = 0.0;
        const Run run = native_run(row(count, gap), constant(acceleration, 2), settings);
        const double exact = kMass * count * (acceleration - friction * kGravity);
        CAPTURE(static_cast<int>(accuracy), count, friction, acceleration, text(last_force(run, kFront) / exact - 1.0),
                text(walls(run).lasting_force[kFront] / exact - 1.0));
        CHECK(last_force(run, kFront) == Approx(exact).epsilon(1e-6));
      }
    }
  }
}

// A load that rests in its pose all the time: how the acceleration came to be must not show.
TEST_CASE("wall_forces: of a real load at rest they depend on the pose alone", "[physics][walls]") {
  constexpr double kStrength = 0.5 * kGravity;
  constexpr std::size_t kLeft = 3;
  std::vector<std::pair<double, Vec3>> rising;
  for (int i = 0; i < 60; ++i) rising.emplace_back(0.01, Vec3(0, kStrength * i / 60.0, 0));
  rising.emplace_back(0.4, Vec3(0, kStrength, 0));
  std::optional<double> first;
  for (const Accuracy accuracy : kAll) {
    Settings settings = at_once();
    settings.contact.friction_model = FrictionModel::pairs;
    settings.contact.box_box = settings.contact.box_floor = settings.contact.box_wall = 0.52;
    settings = measured(with(accuracy, settings));
    const Layout layout = bundled_layout("BR0_012_block", settings);
    for (const Acceleration& acceleration :
         {acceleration_of({{1.0, Vec3(0, kStrength, 0)}}), acceleration_of(rising)}) {
      const Run run = native_run(layout, acceleration, settings);
      REQUIRE(run.record.row.steps == run.record.row.steps_skipped);
      const double force = last_force(run, kLeft);
      if (!first) first = force;
      CAPTURE(static_cast<int>(accuracy), text(force));
      CHECK(force > 1000.0);
      CHECK(force == Approx(*first).epsilon(1e-4));
    }
  }
}

TEST_CASE("wall_forces: the floor carries the weight, centred below where the effective gravity points",
          "[physics][walls]") {
  for (const Accuracy accuracy : kAll) {
    Settings settings = measured(with(accuracy, open_floor(0.6)));
    settings.materials[1].centre_of_mass = {0.1, -0.2, 0.05};
    const double acceleration = 3.0;
    // 1 m x 1.2 m x 0.4 m at rest, and braked below the limit of friction.
    const Layout layout = layout_of({box({4, 5, 0}, {1.0, 1.2, 0.4})});
    const Run rest = native_run(layout, constant(0, 1), settings);
    const Run braked = native_run(layout, constant(acceleration, 1), settings);
    CAPTURE(static_cast<int>(accuracy));
    for (const Run* run : {&rest, &braked}) {
      CHECK(walls(*run).peak_force[kFloor] == Approx(kMass * kGravity).epsilon(1e-6));
      CHECK(walls(*run).peak_force[kFront] == 0.0);
    }
    const Vec3 centre(4.6, 5.4, 0.25);
    CHECK((walls(rest).peak_point[kFloor] - Vec3(centre.x(), centre.y(), 0)).norm() < 1e-6);
    const Vec3 shifted(centre.x() - acceleration / kGravity * centre.z(), centre.y(), 0);
    CHECK((walls(braked).peak_point[kFloor] - shifted).norm() < 1e-6);
    CHECK((walls(braked).impulse[kFloor] - Vec3(-acceleration, 0, -kGravity) * kMass).norm() < 1e-5 * kMass * kGravity);
  }
}

TEST_CASE("wall_forces: all sides together balance weight and change of momentum", "[physics][walls][slow]") {
  for (const char* name : {"BR5_020_layer_h60", "BR8_009_wall_h60", "seed_example"}) {
    for (const Accuracy accuracy : kAll) {
      const Settings settings = measured(with(accuracy, Settings{}));
      const Layout layout = bundled_layout(name, settings);
      const Acceleration acceleration =
          acceleration_of({{0.2, Vec3::Zero()}, {0.4, Vec3(8, 3, 0)}, {0.2, Vec3(-4, -5, 1)}});
      const Run run = native_run(layout, acceleration, settings);
      CAPTURE(name, static_cast<int>(accuracy), text(imbalance(layout, acceleration, settings, run)));
      // Where boxes move at the end, what the last solve has left is missing.
      CHECK(imbalance(layout, acceleration, settings, run) < (accuracy == Accuracy::screening ? 1e-5 : 5e-7));
    }
  }
}

TEST_CASE("wall_forces: measuring changes no bit", "[physics][walls][slow]") {
  const Layout layout = bundled_layout("BR5_020_layer_h60", Settings{});
  for (const char* engine : {"native", "bullet"}) {
    Settings settings = at_once();
    settings.native.accuracy = Accuracy::screening;
    const Acceleration acceleration = constant(9, 0.4);
    const Run without = run(engine, layout, acceleration, settings);
    const Run with_forces = run(engine, layout, acceleration, measured(settings));
    CHECK(without.record.row.state_hash == with_forces.record.row.state_hash);
    CHECK(without.record.found.get<WallForces>() == nullptr);
    CHECK(walls(with_forces).known());
  }
}

}  // namespace wall_forces_test
