#include "analyses/damage/damage_recorder.hpp"

#include <catch2/catch.hpp>
#include <vector>

namespace damage_recorder_test {

using namespace holdfast::internal;

namespace {

constexpr double kWindow = 0.02;
constexpr double kGravity = 9.81;
constexpr DamageBoundary kBoundary{.acceleration = 100.0, .velocity_change = 1.5};

/// A recorder of one box, driven by hand.
class Driven {
 public:
  Driven() : recorder_(kBoundary, kWindow, kGravity, state()) {}

  /// A step at whose end the box has that velocity in the container, which is accelerated.
  void step(double until, const Vec3& velocity, const Vec3& acceleration = Vec3::Zero()) {
    velocity_.front() = velocity;
    recorder_.step({.begin = time_, .end = until, .acceleration = acceleration, .after = state()});
    time_ = until;
  }

  double peak() const { return static_cast<double>(recorder_.damage().peak_acceleration.front()); }
  double change() const { return static_cast<double>(recorder_.damage().velocity_change.front()); }
  bool beyond() const { return recorder_.damage().boxes_beyond == 1; }

 private:
  StateView state() const { return {.position = {}, .orientation = {}, .velocity = velocity_, .angular_velocity = {}}; }

  std::vector<Vec3> velocity_ = {Vec3::Zero()};
  double time_ = 0.0;
  DamageRecorder recorder_;
};

}  // namespace

TEST_CASE("damage_recorder: a blow counts in full, however steps cut the time", "[core][damage]") {
  for (const double step : {0.001, 0.004, 0.0125, 0.0175}) {
    Driven box;
    double time = 0.0;
    for (int i = 0; i < 20; ++i) box.step(time += step, {0, 0, 0});
    for (int i = 0; i < 20; ++i) box.step(time += step, {2, -1, 0});
    CAPTURE(step);
    CHECK(box.change() == Approx(std::sqrt(5.0)));
    CHECK(box.peak() == Approx(std::sqrt(5.0) / kWindow));
    CHECK(box.beyond());
  }
}

TEST_CASE("damage_recorder: a blow that takes several steps is one impact, two blows are two", "[core][damage]") {
  Driven box;
  box.step(0.01, {0.5, 0, 0});
  box.step(0.02, {1.5, 0, 0});
  box.step(0.03, {1.0, 0, 0});  // bounces back a little
  CHECK(box.change() == Approx(1.5));
  for (int i = 4; i < 20; ++i) box.step(0.01 * i, {1.0, 0, 0});
  box.step(0.2, {1.8, 0, 0});
  CHECK(box.change() == Approx(1.5));
  CHECK(box.peak() == Approx(1.5 / kWindow));
  // The acceleration is beyond 75 m/s², but not beyond the boundary.
  CHECK_FALSE(box.beyond());
}

TEST_CASE("damage_recorder: what the container does to a box that it carries is no impact", "[core][damage]") {
  Driven box;
  for (int i = 1; i <= 100; ++i) box.step(0.01 * i, {0, 0, 0}, {30.0, 0, 0});
  CHECK(box.peak() == Approx(30.0));
  CHECK(box.change() == 0.0);
}

TEST_CASE("damage_recorder: a box that the container leaves behind, or that falls, has no impact", "[core][damage]") {
  Driven behind;
  for (int i = 1; i <= 100; ++i) behind.step(0.01 * i, {-8.0 * 0.01 * i, 0, 0}, {8.0, 0, 0});
  CHECK(behind.peak() < 1e-5);
  CHECK(behind.change() == 0.0);
  Driven falling;
  for (int i = 1; i <= 100; ++i) falling.step(0.01 * i, {0, 0, -kGravity * 0.01 * i});
  CHECK(falling.peak() == Approx(kGravity));
  CHECK(falling.change() == 0.0);
}

TEST_CASE("damage_recorder: an acceleration that is shorter than the window counts in part", "[core][damage]") {
  Driven box;
  box.step(0.3, {0, 0, 0});
  box.step(0.305, {0, 0, 0}, {8.0, 0, 0});  // 5 ms of 8 m/s²
  box.step(2.0, {0, 0, 0});
  CHECK(box.peak() == Approx(8.0 * 0.005 / kWindow));
}

TEST_CASE("damage_recorder: both numbers of the boundary must be exceeded", "[core][damage]") {
  Driven slow;  // 3 m/s by 60 m/s²: a large change of velocity, a small acceleration
  for (int i = 1; i <= 50; ++i) slow.step(0.001 * i, {0.06 * i, 0, 0});
  CHECK(slow.change() == Approx(3.0));
  CHECK(slow.peak() == Approx(60.0));
  CHECK_FALSE(slow.beyond());
}

}  // namespace damage_recorder_test
