#include "validate/answers/sliding_block.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace sliding_block_test {

using namespace holdfast::internal;

namespace {

constexpr double kFriction = 0.5 * 9.81;

Acceleration acceleration_of(std::initializer_list<std::pair<double, double>> pieces) {
  Acceleration acceleration;
  for (const auto& [duration, value] : pieces)
    acceleration.segments.push_back({acceleration.end_time(), duration, Vec3(value, 0, 0)});
  return acceleration;
}

}  // namespace

TEST_CASE("sliding_block: the path after a brake pulse agrees with the formula", "[validate][sliding_block]") {
  const double acceleration = 0.8 * 9.81;
  const SlidingBlock end = slide_along_x(acceleration_of({{0.5, acceleration}, {2.0, 0.0}}), kFriction);
  CHECK(end.displacement == Approx(-0.5 * (acceleration - kFriction) * 0.25 * acceleration / kFriction).epsilon(1e-14));
  CHECK(end.velocity == 0.0);
  CHECK(end.distance == Approx(-end.displacement));
}

TEST_CASE("sliding_block: the block does not slide at its limit and below", "[validate][sliding_block]") {
  const SlidingBlock end = slide_along_x(acceleration_of({{1.0, kFriction}, {1.0, -kFriction}, {1.0, 0.3}}), kFriction);
  CHECK(end.displacement == 0.0);
  CHECK(end.velocity == 0.0);
}

TEST_CASE("sliding_block: opposite pulses cancel", "[validate][sliding_block]") {
  const SlidingBlock end = slide_along_x(acceleration_of({{0.2, 8.0}, {1.0, 0.0}, {0.2, -8.0}, {1.0, 0.0}}), kFriction);
  CHECK(std::abs(end.displacement) < 1e-15);
  CHECK(end.distance == Approx(2 * 0.5 * (8.0 - kFriction) * 0.04 * 8.0 / kFriction).epsilon(1e-12));
}

TEST_CASE("sliding_block: an opposite acceleration stops the block, then moves it back", "[validate][sliding_block]") {
  // First 0.2 s to v = −3.095 · 0.2; then 8 m/s² in the other direction: it stops after |v| / (8 + μg), then
  // accelerates with 3.095 in that direction.
  const SlidingBlock end = slide_along_x(acceleration_of({{0.2, 8.0}, {0.5, -8.0}}), kFriction);
  const double excess = 8.0 - kFriction;
  const double speed = excess * 0.2;
  const double stop = speed / (8.0 + kFriction);
  const double back = 0.5 - stop;
  CHECK(end.velocity == Approx(excess * back).epsilon(1e-13));
  CHECK(end.displacement ==
        Approx(-0.5 * excess * 0.04 - 0.5 * speed * stop + 0.5 * excess * back * back).epsilon(1e-13));
}

}  // namespace sliding_block_test
