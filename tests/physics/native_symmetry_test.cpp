// The native engine knows neither left nor right, nor who comes first, nor units of mass and length.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/native/native_engine.hpp"
#include "physics/measures.hpp"

namespace native_symmetry_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

/// Only a floor, so that a scene may lie about the origin, where a mirrored number is the negative one.
Settings bare_floor(double floor_friction, Accuracy accuracy) {
  Settings settings = open_floor(floor_friction);
  settings.contact.box_box = 0.4;
  settings.container.open_sides = {"front", "rear", "left", "right"};
  settings.container.bed_height = 0.0;
  settings.native.accuracy = accuracy;
  return settings;
}

/// Boxes that slide and hit each other off centre, so that they turn, and a stack that leans and falls over.
Layout turning_scene() {
  Layout layout = layout_of({box({-1.5, -0.5, 0}, {0.75, 0.5, 0.5}), box({-0.625, -0.25, 0}, {0.5, 0.625, 0.5}),
                             box({0.25, 0.25, 0}, {0.5, 0.75, 0.25})});
  for (int i = 0; i < 4; ++i) layout.boxes.push_back(box({1.5, 0.25, 0.375 * i}, {0.3125, 0.25, 0.375}));
  return layout;
}

/// Stacks that slide, also over each other, and do not turn.
Layout sliding_scene() {
  Layout layout = layout_of({});
  for (int i = 0; i < 4; ++i) {
    layout.boxes.push_back(box({-2.5, 0.25, 0.25 * i}, {1.25, 1.5, 0.25}));
    layout.boxes.push_back(box({0.5, -1.125, 0.125 * i}, {0.875, 0.75, 0.125}));
  }
  return layout;
}

Layout mirrored(Layout layout, int axis) {
  for (Box& box : layout.boxes) {
    std::swap(box.corner_min[axis], box.corner_max[axis]);
    box.corner_min[axis] = -box.corner_min[axis];
    box.corner_max[axis] = -box.corner_max[axis];
  }
  return layout;
}

Acceleration mirrored(Acceleration acceleration, int axis) {
  for (Segment& segment : acceleration.segments) segment.acceleration[axis] = -segment.acceleration[axis];
  return acceleration;
}

/// A mirror turns rotations about its own axis the same way, and all others the opposite way.
Vec3 mirrored_spin(Vec3 spin, int axis) {
  spin = -spin;
  spin[axis] = -spin[axis];
  return spin;
}

/// Largest difference between a state and the mirror image of the other, of any of their numbers.
double asymmetry(const StateColumns& state, const StateColumns& image, int axis) {
  double worst = 0.0;
  const auto mirrored_place = [&](Vec3 v) {
    v[axis] = -v[axis];
    return v;
  };
  for (std::size_t i = 0; i < state.position.size(); ++i) {
    const auto differs = [&](const Vec3& a, const Vec3& b) {
      worst = std::max(worst, Vec3(a - b).cwiseAbs().maxCoeff());
    };
    differs(state.position[i], mirrored_place(image.position[i]));
    differs(state.velocity[i], mirrored_place(image.velocity[i]));
    differs(state.angular_velocity[i], mirrored_spin(image.angular_velocity[i], axis));
    differs(state.orientation[i].vec(), mirrored_spin(image.orientation[i].vec(), axis));
    worst = std::max(worst, std::abs(state.orientation[i].w() - image.orientation[i].w()));
  }
  return worst;
}

double largest_turn(const StateColumns& state) {
  double largest = 0.0;
  for (const Rotation& rotation : state.orientation) largest = std::max(largest, Vec3(rotation.vec()).norm());
  return largest;
}

const Acceleration kSwerve = acceleration_of({{0.3, Vec3(5, 3, 0)}, {0.3, Vec3(-2, 6, 0)}});

constexpr std::initializer_list<Accuracy> kAll = {Accuracy::screening, Accuracy::standard, Accuracy::reference};

/// Checks that a mirrored scene moves as the mirrored one, at most `bound` off in any number.
/// @return how far the box that turned farthest did, at the accuracy at which that is least
double check_mirrors(const Layout& layout, std::initializer_list<Accuracy> accuracies, double bound) {
  double least_turn = 1.0;
  for (const Accuracy accuracy : accuracies) {
    const Settings settings = bare_floor(0.25, accuracy);
    const NativeEngine engine(settings);
    const Run run_here = run(engine, layout, kSwerve, settings);
    least_turn = std::min(least_turn, largest_turn(run_here.state));
    for (const int axis : {0, 1}) {
      const Run image = run(engine, mirrored(layout, axis), mirrored(kSwerve, axis), settings);
      const double worst = asymmetry(run_here.state, image.state, axis);
      CAPTURE(static_cast<int>(accuracy), axis, text(worst), text(largest_turn(run_here.state)));
      CHECK(worst <= bound);
      CHECK(run_here.displacement().norm() > 0.1);
    }
  }
  return least_turn;
}

}  // namespace

TEST_CASE("native_symmetry: a mirrored scene moves as in a mirror", "[physics][native_symmetry]") {
  check_mirrors(sliding_scene(), {Accuracy::screening, Accuracy::standard}, 1e-13);
  // Rounding may decide which of its many iterations is the last.
  check_mirrors(sliding_scene(), {Accuracy::reference}, 1e-11);
  // Sums over points are in another order in a mirror, and a load that turns makes more of rounding.
  CHECK(check_mirrors(turning_scene(), {Accuracy::standard}, 0.03) > 0.04);
  CHECK(check_mirrors(turning_scene(), {Accuracy::reference}, 2e-4) > 0.04);
}

// Expected: to the last bit, as the geometry of contacts has it; sums over points are in another order in a mirror.
TEST_CASE("native_symmetry: a mirrored scene has the mirrored bits", "[.][physics][native_symmetry]") {
  check_mirrors(sliding_scene(), kAll, 0.0);
  CHECK(check_mirrors(turning_scene(), kAll, 0.0) > 0.04);
}

namespace {

void check_renumbering(const Layout& layout, Accuracy accuracy) {
  const Settings settings = bare_floor(0.25, accuracy);
  const NativeEngine engine(settings);
  const Run run_here = run(engine, layout, kSwerve, settings);
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    std::vector<std::size_t> order(layout.boxes.size());
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    Layout shuffled = layout;
    StateColumns expected = run_here.state;
    for (std::size_t i = 0; i < order.size(); ++i) {
      shuffled.boxes[i] = layout.boxes[order[i]];
      for_each_state_column([&](const char*, const auto& from, auto& to) { to[i] = from[order[i]]; }, run_here.state,
                            expected);
    }
    CAPTURE(static_cast<int>(accuracy), layout.boxes.size(), seed);
    CHECK(same_bits(run(engine, shuffled, kSwerve, settings).state, expected));
  }
}

}  // namespace

TEST_CASE("native_symmetry: renumbered boxes have the same bits", "[physics][native_symmetry]") {
  for (const Accuracy accuracy : kAll) {
    check_renumbering(sliding_scene(), accuracy);
    check_renumbering(turning_scene(), accuracy);
  }
}

TEST_CASE("native_symmetry: masses scaled by a power of 2 move with the same bits", "[physics][native_symmetry]") {
  for (const Accuracy accuracy : {Accuracy::screening, Accuracy::standard}) {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
      Random random(seed);
      const Layout layout = random_layout(random);
      const Acceleration acceleration = random_acceleration(random, 0.2);
      const auto run_with = [&](double scale) {
        Settings settings = small_container(accuracy);
        settings.density_value *= scale;
        return run(NativeEngine(settings), layout, acceleration, settings);
      };
      const Run run_here = run_with(1.0);
      for (const double scale : {0.125, 2.0, 1024.0}) {
        CAPTURE(static_cast<int>(accuracy), seed, scale);
        CHECK(same_bits(run_with(scale).state, run_here.state));
      }
    }
  }
}

TEST_CASE("native_symmetry: a scene of other lengths moves alike, in the root of their time",
          "[physics][native_symmetry]") {
  // Lengths by 4 or 1/4, times by 2 or 1/2: accelerations stay.
  for (const Accuracy accuracy : {Accuracy::standard, Accuracy::reference}) {
    const double rate = accuracy == Accuracy::standard ? 240.0 : 1440.0;
    const double bound = accuracy == Accuracy::standard ? 5e-3 : 1e-3;
    for (const Layout& layout : {sliding_scene(), turning_scene()}) {
      const auto run_with = [&](double length, double time) {
        Settings settings = bare_floor(0.25, accuracy);
        settings.container.size *= length;
        settings.native.steps_per_second = rate / time;
        Layout scaled = layout;
        for (Box& box : scaled.boxes) {
          box.corner_min *= length;
          box.corner_max *= length;
        }
        Acceleration acceleration = kSwerve;
        for (Segment& segment : acceleration.segments) {
          segment.start *= time;
          segment.duration *= time;
        }
        return run(NativeEngine(settings), scaled, acceleration, settings);
      };
      const Run run_here = run_with(1.0, 1.0);
      for (const auto& [length, time] : {std::pair(4.0, 2.0), std::pair(0.25, 0.5)}) {
        const Run other = run_with(length, time);
        double worst = 0.0;
        for (std::size_t i = 0; i < layout.boxes.size(); ++i)
          worst = std::max(worst, (other.state.position[i] / length - run_here.state.position[i]).norm());
        CAPTURE(static_cast<int>(accuracy), layout.boxes.size(), length, text(worst));
        CHECK(worst < bound);
      }
    }
  }
}

}  // namespace native_symmetry_test
