// Static and kinetic friction of the native engine, against Newmark's block and against one coefficient.

#include <catch2/catch.hpp>

#include "core/native/native_engine.hpp"
#include "core/reference/plain_engine.hpp"
#include "physics/measures.hpp"
#include "validate/answers/sliding_block.hpp"

namespace kinetic_friction_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

constexpr double kStatic = 0.5;
constexpr double kShare = 0.75;

Settings kinetic_settings(Accuracy accuracy) {
  Settings settings = open_floor(kStatic);
  settings.native.accuracy = accuracy;
  settings.contact.kinetic_friction = kShare;
  return settings;
}

Run pushed(const Layout& layout, const Settings& settings, double acceleration, double duration = 1.0) {
  return run(NativeEngine(settings), layout, constant(acceleration, duration), settings);
}

}  // namespace

TEST_CASE("kinetic_friction: a box starts at the static limit and slides with kinetic friction", "[physics][kinetic]") {
  const auto [accuracy, error] = GENERATE(std::pair(Accuracy::screening, 1e-4), std::pair(Accuracy::standard, 1e-5),
                                          std::pair(Accuracy::reference, 1e-6));
  const Settings settings = kinetic_settings(accuracy);
  const Layout layout = layout_of({box({9, 9, 0}, {1.0, 1.0, 0.2})});
  CHECK(pushed(layout, settings, 0.99 * kStatic * kGravity).displacement() == Vec3::Zero());
  for (const double share : {1.001, 1.01, 1.05, 1.2, 2.0}) {
    CAPTURE(share);
    const double excess = (share - kShare) * kStatic * kGravity;
    CHECK(-pushed(layout, settings, share * kStatic * kGravity).displacement().x() ==
          Approx(0.5 * excess).epsilon(error));
  }
}

TEST_CASE("kinetic_friction: what holds while its load slides gives way at the static limit", "[physics][kinetic]") {
  // 50 kg slide on 100 kg, which hold until a second acceleration is above what friction holds of them.
  Settings settings = kinetic_settings(GENERATE(Accuracy::screening, Accuracy::standard, Accuracy::reference));
  settings.contact.friction_model = FrictionModel::pairs;
  settings.contact.box_floor = 0.4;
  settings.contact.box_box = 0.3;
  const Layout layout =
      layout_of({weighing(box({9, 9, 0}, {1, 1, 0.2}), 100.0), weighing(box({9, 9, 0.2}, {1, 1, 0.15}), 50.0)});
  const double floor = 0.4 * 150.0 * kGravity, between = kShare * 0.3 * 50.0 * kGravity;
  const double limit = (floor - between) / 100.0;
  for (const double share : {0.999, 1.001, 1.01, 1.1}) {
    CAPTURE(share);
    const Run end = run(NativeEngine(settings), layout,
                        acceleration_of({{0.1, Vec3(4.0, 0, 0)}, {0.1, Vec3(share * limit, 0, 0)}}), settings);
    const double gain = share < 1.0 ? 0.0 : (100.0 * share * limit + between - kShare * floor) / 100.0;
    CHECK(-end.displacement(0).x() == Approx(0.5 * gain * 0.01).epsilon(1e-3).margin(1e-7));
  }
}

TEST_CASE("kinetic_friction: a box that tips over an edge that sticks tips as with one coefficient",
          "[physics][kinetic]") {
  // While it tips, the edge calls for more than kinetic friction. Corners that are lifted move sideways and do not
  // count; where the box is pushed obliquely, a corner that sticks may be at its limit, and does not count either.
  struct Case {
    Vec3 size;
    double friction, share;
    Vec3 acceleration;
    double duration;
  };
  const Case given = GENERATE(Case{{0.96, 2.5, 1.6}, 0.75, 0.75, {0.96 * kGravity, 0, 0}, 0.38},
                              Case{{0.42, 2.5, 0.76}, 0.76, 0.75, {1.14 * kGravity, 0, 0}, 0.3},
                              Case{{0.8, 2.5, 1.6}, 0.9, 0.5, {1.2 * kGravity, 0, 0}, 0.3},
                              Case{{1.784, 0.878, 1.616}, 0.929, 0.5, {-4.8, 11.825, 0}, 0.257},
                              Case{{1.784, 0.878, 1.616}, 0.929, 0.75, {-5.0, 11.825, 0}, 0.257});
  Settings settings = kinetic_settings(GENERATE(Accuracy::screening, Accuracy::standard, Accuracy::reference));
  settings.contact.friction_model = FrictionModel::pairs;
  settings.contact.box_floor = given.friction;
  settings.contact.kinetic_friction = given.share;
  Settings one = settings;
  one.contact.kinetic_friction = 1.0;
  const Layout layout = layout_of({box({9, 9, 0}, given.size)});
  const Acceleration acceleration = acceleration_of({{given.duration, given.acceleration}});
  const Run end = run(NativeEngine(settings), layout, acceleration, settings);
  CAPTURE(given.size.transpose(), given.share, static_cast<int>(settings.native.accuracy));
  CHECK(end.displacement().norm() > 0.1);
  CHECK(same_bits(end.state, run(NativeEngine(one), layout, acceleration, one).state));
}

TEST_CASE("kinetic_friction: a load that slides as a whole does so at every size", "[physics][kinetic]") {
  // More than the eight boxes of a small island, whose solves stop sooner.
  const Settings settings = kinetic_settings(GENERATE(Accuracy::screening, Accuracy::standard));
  const Layout tower = stack(10, {9, 9, 0}, {1.5, 1.5, 0.1});
  CHECK(pushed(tower, settings, 0.98 * kStatic * kGravity).displacement(9).norm() < 1e-9);
  for (const double share : {1.001, 1.2}) {
    CAPTURE(share);
    const double excess = (share - kShare) * kStatic * kGravity;
    // Its lowest box slides; the others, which need less friction between them, stay on it.
    const Run end = pushed(tower, settings, share * kStatic * kGravity);
    for (const std::size_t i : {0U, 5U, 9U}) CHECK(-end.displacement(i).x() == Approx(0.5 * excess).epsilon(1e-5));
  }
}

TEST_CASE("kinetic_friction: what slides goes on where it would not have started, stops, and holds again",
          "[physics][kinetic]") {
  const double limit = kStatic * kGravity;
  const Acceleration acceleration = acceleration_of({{0.3, Vec3(1.2 * limit, 0, 0)},
                                                     {0.3, Vec3(0.85 * limit, 0, 0)},
                                                     {0.5, Vec3::Zero()},
                                                     {0.5, Vec3(0.9 * limit, 0, 0)},
                                                     {0.4, Vec3(-1.1 * limit, 0, 0)}});
  const SlidingBlock exact = slide_along_x(acceleration, {limit, kShare * limit});
  const auto [accuracy, error] = GENERATE(std::pair(Accuracy::screening, 1e-2), std::pair(Accuracy::reference, 1e-5));
  const Settings settings = kinetic_settings(accuracy);
  const Run end = run(NativeEngine(settings), layout_of({box({9, 9, 0}, {1.0, 1.0, 0.2})}), acceleration, settings);
  CHECK(end.displacement().x() == Approx(exact.displacement).epsilon(error));
}

TEST_CASE("kinetic_friction: less of it moves a load farther", "[physics][kinetic]") {
  Settings settings = at_once();
  settings.native.accuracy = Accuracy::screening;
  const Layout layout = bundled_layout("BR8_009_wall_h60", settings);
  double before = 0.0;
  for (const double share : {1.0, 0.75, 0.5}) {
    settings.contact.kinetic_friction = share;
    const Run end = run(NativeEngine(settings), layout, constant(0.6 * kGravity, 0.5), settings);
    double sum = 0.0;
    for (std::size_t i = 0; i < layout.boxes.size(); ++i) sum += end.displacement(i).norm();
    CAPTURE(share);
    CHECK(sum > before);
    before = sum;
  }
}

TEST_CASE("kinetic_friction: engines that have one coefficient refuse it", "[physics][kinetic]") {
  Settings settings = kinetic_settings(Accuracy::standard);
  for (const char* name : {"native-plain", "bullet"}) {
    const auto engine = make_engine(name, settings);
    REQUIRE_FALSE(engine);
    CHECK(engine.error().message() ==
          "this engine has one friction coefficient for what sticks and what slides: " + std::string(name) +
              "; KineticFriction = 1 in [Contact], or the engine native");
  }
}

}  // namespace kinetic_friction_test
