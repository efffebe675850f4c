#include "validate/answers/stick_slip.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "validate/answers/sampled_wave.hpp"
#include "validate/laboratory/scene.hpp"

namespace stick_slip_test {

using namespace holdfast::internal;

namespace {

constexpr double kGravity = 9.81;

Acceleration pulse(double duration, double acceleration, double after) {
  return Scene().then(duration, {acceleration, 0, 0}).then(after, Vec3::Zero()).acceleration;
}

}  // namespace

TEST_CASE("stick_slip: a pulse moves a block by ½ (a − μg) T² a/(μg) and it stops at a T/(μg)", "[validate]") {
  const double friction = 0.3;
  const double limit = friction * kGravity;
  const double acceleration = 0.8 * kGravity;
  const double duration = 0.7;
  const SlidePath path = slide_along(0, pulse(duration, acceleration, 5.0), friction, kGravity);
  CHECK(path.stop_time == Approx(acceleration * duration / limit).epsilon(1e-12));
  CHECK(path.displacement.x() ==
        Approx(-0.5 * (acceleration - limit) * duration * duration * acceleration / limit).epsilon(1e-12));
  CHECK(path.velocity.x() == 0.0);
}

TEST_CASE("stick_slip: nothing moves at the limit, and less weight lowers the limit", "[validate]") {
  CHECK(slide_along(0, pulse(1.0, 0.5 * kGravity, 1.0), 0.5, kGravity).displacement.isZero(0.0));
  const Acceleration heave = Scene().then(1.0, {0.4 * kGravity, 0, -0.5 * kGravity}).acceleration;
  // The weight is halved: a = 0.4 g − 0.5 · 0.5 g.
  CHECK(slide_along(0, heave, 0.5, kGravity).displacement.x() == Approx(-0.5 * 0.15 * kGravity).epsilon(1e-12));
}

TEST_CASE("stick_slip: the path after two opposite pulses agrees with closed formulas", "[validate]") {
  const double friction = 0.2;
  const double limit = friction * kGravity;
  const double a = 3.0;
  const Acceleration acceleration =
      Scene().then(1.0, {a, 0, 0}).then(1.0, {-a, 0, 0}).then(9.0, Vec3::Zero()).acceleration;
  // First half: −(a − μg) for 1 s; then +(a + μg) until it stops at t₁, +(a − μg) for the remaining time, then −μg
  // until it stops.
  const double speed = a - limit;
  const double t1 = speed / (a + limit);
  const double back = (a - limit) * (1.0 - t1);
  const double expected = -0.5 * speed - 0.5 * speed * t1 + 0.5 * back * (1.0 - t1) + 0.5 * back * back / limit;
  const SlidePath path = slide_along(0, acceleration, friction, kGravity);
  CHECK(path.displacement.x() == Approx(expected).epsilon(1e-12));
  CHECK(path.stop_time == Approx(2.0 + back / limit).epsilon(1e-12));
}

TEST_CASE("stick_slip: the integration in the plane is exact along a line", "[validate]") {
  const Vec3 direction = Vec3(0.8, 0.6, 0.0);
  const Acceleration acceleration = Scene().then(0.7, 0.8 * kGravity * direction).then(5.0, Vec3::Zero()).acceleration;
  const SlidePath line = slide_along(0, pulse(0.7, 0.8 * kGravity, 5.0), 0.3, kGravity);
  const SlidePath plane = slide_over(acceleration, 0.3, kGravity);
  CHECK((plane.displacement - line.displacement.x() * direction).norm() < 1e-9);
  CHECK(plane.stop_time == Approx(line.stop_time).epsilon(1e-9));
}

// With the speed s at the angle φ to the inertial acceleration f and p = μg/f > 1, s sinφ / tan(φ/2)^p is constant.
// From φ = 90° to the stop this integrates to T = s₀ p / (f (p² − 1)), with the path s₀² / (4 f (p² − 1)) along f and
// 2 s₀² p / (f (4 p² − 1)) perpendicular to it.
TEST_CASE("stick_slip: the path under a lateral acceleration agrees with the closed formula", "[validate]") {
  const double friction = 0.5;
  const double push = 0.3 * kGravity;
  const double speed = 2.0;
  const double p = friction * kGravity / push;
  const Acceleration acceleration = Scene().then(5.0, {-push, 0, 0}).acceleration;
  const SlidePath path = slide_over(acceleration, friction, kGravity, {0, speed, 0});
  CHECK(path.stop_time == Approx(speed * p / (push * (p * p - 1.0))).epsilon(1e-7));
  CHECK(path.displacement.x() == Approx(speed * speed / (4.0 * push * (p * p - 1.0))).epsilon(1e-8));
  CHECK(path.displacement.y() == Approx(2.0 * speed * speed * p / (push * (4.0 * p * p - 1.0))).epsilon(1e-8));
}

TEST_CASE("stick_slip: stacked blocks slide together, or only the upper one slides", "[validate]") {
  const Acceleration acceleration = pulse(0.5, 0.8 * kGravity, 5.0);
  const StackedPaths together = slide_stacked(acceleration, {3.0, 1.0, 0.2, 0.4, kGravity});
  const double alone = slide_along(0, acceleration, 0.2, kGravity).displacement.x();
  CHECK(together.lower == Approx(alone).epsilon(1e-12));
  CHECK(together.upper == Approx(alone).epsilon(1e-12));
  const StackedPaths upper = slide_stacked(acceleration, {3.0, 1.0, 0.9, 0.3, kGravity});
  CHECK(upper.lower == 0.0);
  CHECK(upper.upper == Approx(slide_along(0, acceleration, 0.3, kGravity).displacement.x()).epsilon(1e-12));
}

TEST_CASE("stick_slip: stacked blocks that both slide follow Newton's laws", "[validate]") {
  const StackedBlocks blocks{3.0, 1.0, 0.3, 0.2, kGravity};
  const double push = 0.8 * kGravity;
  const StackedPaths at = slide_stacked(Scene().then(0.5, {-push, 0, 0}).acceleration, blocks);
  const double upper = push - 0.2 * kGravity;
  const double lower = push + (0.2 * 1.0 - 0.3 * 4.0) * kGravity / 3.0;
  CHECK(at.upper == Approx(0.125 * upper).epsilon(1e-12));
  CHECK(at.lower == Approx(0.125 * lower).epsilon(1e-12));
  CHECK(at.lower_velocity == Approx(0.5 * lower).epsilon(1e-12));
  CHECK(at.upper_velocity == Approx(0.5 * upper).epsilon(1e-12));
}

TEST_CASE("stick_slip: a block starts at the static limit and slides, stops and holds with a kinetic share",
          "[validate]") {
  const double limit = 0.5 * kGravity;
  const double share = 0.75;
  // From 1.2 of the limit it gains 0.45 of it; at 0.85 still 0.1, and then 0.75 stop it; 0.9 does not start it.
  Scene scene;
  for (const auto& [duration, part] : {std::pair(0.3, 1.2), {0.3, 0.85}, {0.5, 0.0}, {0.5, 0.9}})
    scene.then(duration, {part * limit, 0, 0});
  const SlidePath path = slide_along(0, scene.acceleration, 0.5, kGravity, 0.0, share);
  const double first = 0.3 * 0.45 * limit;
  const double second = first + 0.3 * 0.1 * limit;
  const double stop = second / (share * limit);
  const double way = 0.5 * 0.3 * first + 0.5 * 0.3 * (first + second) + 0.5 * stop * second;
  CHECK(path.displacement.x() == Approx(-way).epsilon(1e-12));
  CHECK(path.distance == Approx(way).epsilon(1e-12));
  CHECK(path.stop_time == Approx(0.6 + stop).epsilon(1e-12));
  CHECK(path.velocity.x() == 0.0);
  // Heave changes both limits alike.
  const Acceleration heave = Scene().then(1.0, {0.3 * kGravity, 0, -0.5 * kGravity}).acceleration;
  const SlidePath light = slide_along(0, heave, 0.5, kGravity, 0.0, share);
  CHECK(light.displacement.x() == Approx(-0.5 * (0.3 - share * 0.25) * kGravity).epsilon(1e-12));
}

TEST_CASE("stick_slip: the walks under vibration are those of an independent integration", "[validate]") {
  struct Walk {
    double frequency, duration, mean, shake, heave, phase, expected;
  };
  for (const Walk& walk : {Walk{100, 60, 0.3, 0.5, 0, 0, 0.1311}, Walk{50, 300, 0.35, 0, 0.4, 0, 0.0849},
                           Walk{20, 600, 0.15, 0.3, 0.3, 2, 0.1212}}) {
    const Oscillation oscillation = {walk.mean * kGravity * Vec3::UnitY(),
                                     {{walk.shake * kGravity * Vec3::UnitY(), walk.frequency, 0.0},
                                      {walk.heave * kGravity * Vec3::UnitZ(), walk.frequency, walk.phase}}};
    const SlidePath path = slide_along(1, sampled(oscillation, walk.duration, 1000.0), 0.5, kGravity);
    CAPTURE(walk.frequency, path.displacement.y());
    CHECK(-path.displacement.y() == Approx(walk.expected).margin(5.1e-5));
  }
  const Oscillation biased = {0.4 * kGravity * Vec3::UnitY(), {{0.15 * kGravity * Vec3::UnitY(), 100.0, 0.0}}};
  CHECK(-slide_along(1, sampled(biased, 4.0, 1000.0), 0.5, kGravity, 0.0, 0.75).displacement.y() ==
        Approx(1.969).margin(5.1e-4));
}

TEST_CASE("stick_slip: stacked blocks with a kinetic share slide with it from the static limit on", "[validate]") {
  const double share = 0.75;
  // The upper block alone: it starts at 0.25 g, with 0.1875 g against it, and the floor holds the lower one.
  const StackedPaths upper =
      slide_stacked(Scene().then(0.5, {-0.3 * kGravity, 0, 0}).acceleration, {4.0, 1.0, 0.4, 0.25, kGravity, share});
  CHECK(upper.lower == 0.0);
  CHECK(upper.upper == Approx(0.125 * (0.3 - share * 0.25) * kGravity).epsilon(1e-12));
  const StackedPaths held =
      slide_stacked(Scene().then(0.5, {-0.24 * kGravity, 0, 0}).acceleration, {4.0, 1.0, 0.4, 0.25, kGravity, share});
  CHECK(held.upper == 0.0);
  // Both, one after the other: the lower one has the floor's friction against it and the upper one's with it.
  const StackedBlocks blocks{4.0, 1.0, 0.4, 0.25, kGravity, share};
  const StackedPaths both = slide_stacked(Scene().then(0.5, {-0.6 * kGravity, 0, 0}).acceleration, blocks);
  CHECK(both.upper_velocity == Approx(0.5 * (0.6 - share * 0.25) * kGravity).epsilon(1e-12));
  CHECK(both.lower_velocity == Approx(0.5 * (0.6 + share * (0.25 * 1.0 - 0.4 * 5.0) / 4.0) * kGravity).epsilon(1e-12));
  // Together, as one block on the floor.
  const Acceleration acceleration = pulse(0.4, 0.6 * kGravity, 5.0);
  const Acceleration sine =
      sampled({0.1 * kGravity * Vec3::UnitX(), {{0.6 * kGravity * Vec3::UnitX(), 1.0, 0.0}}}, 4.0, 100.0);
  for (const Acceleration& each : {acceleration, sine}) {
    const StackedPaths together = slide_stacked(each, {4.0, 1.0, 0.4, 0.6, kGravity, share});
    const double alone = slide_along(0, each, 0.4, kGravity, 0.0, share).displacement.x();
    CHECK(together.lower == Approx(alone).epsilon(1e-12));
    CHECK(together.upper == Approx(alone).epsilon(1e-12));
  }
}

}  // namespace stick_slip_test
