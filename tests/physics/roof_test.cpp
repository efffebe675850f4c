// No pressure that nothing pushes: columns that fit exactly between floor and roof, and boxes between walls.

#include <algorithm>
#include <cmath>

#include "core/native/native_scenes.hpp"
#include "core/reference/plain_engine.hpp"
#include "physics/measures.hpp"

namespace roof_test {

using namespace holdfast::internal;
using namespace holdfast::internal::native_scenes;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

constexpr double kHeight = 2.2;                                            ///< of the columns, m
constexpr std::initializer_list<double> kPlays = {0.0, 1e-6, 1e-4, 1e-3};  ///< between column and roof, m
constexpr std::initializer_list<Accuracy> kAll = {Accuracy::screening, Accuracy::standard, Accuracy::reference};

/// A container in which nothing reaches a wall, with a roof.
Settings under_roof(double play, double friction) {
  Settings settings = open_floor(friction);
  settings.container.size = {20, 20, kHeight + play};
  return settings;
}

Layout column(std::size_t count, double length, double width = 1.5) {
  return stack(count, {8, 8, 0}, {length, width, kHeight / static_cast<double>(count)});
}

/// Half a second of nothing, then the accelerations along x, a second each.
Acceleration after_rest(std::initializer_list<double> accelerations) {
  std::vector<std::pair<double, Vec3>> segments = {{0.5, Vec3::Zero()}};
  for (const double acceleration : accelerations) segments.emplace_back(1.0, Vec3(acceleration, 0, 0));
  return acceleration_of(segments);
}

/// Path of the lowest box against the acceleration, m.
double path_of(const Run& run) { return -run.displacement(0).x(); }

/// Acceleration up to which a column that tilts between floor and roof holds, for friction above length over height.
/// It stands on its foremost edge below and presses with the rearmost edge above; with both slipping, the balance of
/// moments about the centre of mass gives the roof's normal force m g (μ h − l) / (2 l), and the friction of both adds
/// up to m g μ² h / l.
double wedge_limit(double friction, double length) { return friction * friction * kGravity * kHeight / length; }

}  // namespace

TEST_CASE("roof: a column that slides without tilting is not held by the roof it touches", "[physics][roof][slow]") {
  constexpr double kFriction = 0.4;
  constexpr double kAcceleration = 5.1;
  const double path = 0.5 * (kAcceleration - kFriction * kGravity);
  for (const double play : kPlays) {
    const Settings settings = under_roof(play, kFriction);
    for (const auto& [count, length] :
         {std::pair<std::size_t, double>(1, 1.2), std::pair<std::size_t, double>(4, 1.0)}) {
      const Layout layout = column(count, length);
      for (const Accuracy accuracy : kAll) {
        const Run run = native_run(layout, after_rest({kAcceleration}), with(accuracy, settings));
        CAPTURE(play, count, static_cast<int>(accuracy), text(path_of(run) / path - 1.0));
        CHECK(path_of(run) == Approx(path).epsilon(1e-5));
      }
      const Run plain = run(PlainEngine(settings), layout, after_rest({kAcceleration}), settings);
      CAPTURE(play, count, text(path_of(plain) / path - 1.0));
      CHECK(path_of(plain) == Approx(path).epsilon(1e-3));
    }
  }
}

TEST_CASE("roof: the limit of a column under the roof is that of one without", "[physics][roof]") {
  constexpr double kFriction = 0.3;
  const double limit = kFriction * kGravity;
  for (const Accuracy accuracy : kAll) {
    const Settings settings = with(accuracy, under_roof(0.0, kFriction));
    for (const std::size_t count : {std::size_t{1}, std::size_t{5}}) {
      const Run below = native_run(column(count, 1.2), after_rest({0.998 * limit}), settings);
      const Run above = native_run(column(count, 1.2), after_rest({1.002 * limit}), settings);
      CAPTURE(static_cast<int>(accuracy), count, text(path_of(below)), text(path_of(above)));
      CHECK(path_of(below) == 0.0);
      CHECK(path_of(above) == Approx(0.5 * 0.002 * limit).epsilon(0.02));
    }
  }
}

TEST_CASE("roof: a column that tilts wedges up to the limit of its two contacts, and slides above it",
          "[physics][roof]") {
  constexpr double kFriction = 0.5;
  const double limit = wedge_limit(kFriction, 1.0);
  REQUIRE(limit > kFriction * kGravity);
  for (const double play : kPlays) {
    const Settings settings = under_roof(play, kFriction);
    for (const std::size_t count : {std::size_t{1}, std::size_t{2}}) {
      for (const Accuracy accuracy : kAll) {
        const Run locked = native_run(column(count, 1.0), after_rest({0.97 * limit}), with(accuracy, settings));
        const Run sliding = native_run(column(count, 1.0), after_rest({1.15 * limit}), with(accuracy, settings));
        const double path = 0.5 * 0.15 * limit;
        CAPTURE(play, count, static_cast<int>(accuracy), text(path_of(locked)), text(path_of(sliding) / path - 1.0));
        // It goes no farther than it takes to tilt through the play.
        CHECK(path_of(locked) < 1e-4 + 5.0 * play);
        // A tilt shifts the contacts.
        CHECK(path_of(sliding) == Approx(path).epsilon(0.005 + 20.0 * play));
      }
    }
  }
}

TEST_CASE("roof: a wedged column that is pushed harder is not held by more than it was pushed", "[physics][roof]") {
  constexpr double kFriction = 0.5;
  const double limit = wedge_limit(kFriction, 1.0);
  for (const Accuracy accuracy : kAll) {
    const Settings settings = with(accuracy, under_roof(0.0, kFriction));
    const Run run = native_run(column(2, 1.0), after_rest({0.9 * limit, 1.15 * limit}), settings);
    CAPTURE(static_cast<int>(accuracy), text(path_of(run)));
    CHECK(path_of(run) == Approx(0.5 * 0.15 * limit).epsilon(0.01));
  }
}

TEST_CASE("roof: a box on a lift presses the roof, and friction holds it there", "[physics][roof]") {
  // The container falls faster than its load: the box is pressed to the roof with m (a − g), and slides along it.
  constexpr double kFriction = 0.5;
  const Vec3 fall(0, 0, -2.0 * kGravity);
  for (const Accuracy accuracy : kAll) {
    for (const double share : {0.9, 1.2}) {
      const Settings settings = with(accuracy, under_roof(0.0, kFriction));
      const double along = share * kFriction * kGravity;
      const Run run =
          native_run(column(1, 1.2), acceleration_of({{0.5, fall}, {1.0, fall + Vec3(along, 0, 0)}}), settings);
      CAPTURE(static_cast<int>(accuracy), share, text(path_of(run)));
      if (share < 1.0) CHECK(path_of(run) < 1e-6);
      if (share > 1.0) CHECK(path_of(run) == Approx(0.5 * 0.2 * kFriction * kGravity).epsilon(1e-3));
    }
  }
}

TEST_CASE("roof: a lower stack beside a full column moves as alone", "[physics][roof]") {
  constexpr double kFriction = 0.4;
  constexpr double kAcceleration = 5.1;
  const Settings settings = under_roof(0.0, kFriction);
  Layout layout = column(4, 1.0);
  for (int i = 0; i < 3; ++i) layout.boxes.push_back(box({8, 9.5, 0.55 * i}, {1.0, 1.5, 0.55}));
  for (const Accuracy accuracy : kAll) {
    const Run run = native_run(layout, after_rest({kAcceleration}), with(accuracy, settings));
    const double path = 0.5 * (kAcceleration - kFriction * kGravity);
    for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
      CAPTURE(static_cast<int>(accuracy), i, text(-run.displacement(i).x()));
      CHECK(-run.displacement(i).x() == Approx(path).epsilon(1e-4));
    }
  }
}

TEST_CASE("roof: a box that is pushed against a wall it touches rests without having moved", "[physics][roof]") {
  Settings settings = open_floor(0.3);
  const Layout row = layout_of({box({0, 8, 0}, {1, 1, 0.4}), box({1, 8, 0}, {1, 1, 0.4}), box({2, 8, 0}, {1, 1, 0.4})});
  for (const Accuracy accuracy : kAll) {
    const Run run = native_run(row, after_rest({8.0, 4.0}), with(accuracy, settings));
    for (std::size_t i = 0; i < 3; ++i) CHECK(run.displacement(i).norm() == 0.0);
  }
}

}  // namespace roof_test
