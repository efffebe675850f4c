#include "validate/answers/sampled_wave.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace sampled_wave_test {

using namespace holdfast::internal;

namespace {

constexpr double kTurn = 6.283185307179586;

}  // namespace

TEST_CASE("sampled_wave: a sample is the mean of its interval", "[validate][sampled_wave]") {
  const Oscillation oscillation = {Vec3(0.5, 0, 0), {{Vec3(2.0, 0, 1.0), 3.0, 0.7}}};
  const Acceleration acceleration = sampled(oscillation, 0.5, 20.0);
  REQUIRE(acceleration.segments.size() == 10);
  for (const Segment& segment : acceleration.segments) {
    const double begin = kTurn * 3.0 * segment.start + 0.7;
    const double end = kTurn * 3.0 * (segment.start + segment.duration) + 0.7;
    const double mean = (std::cos(begin) - std::cos(end)) / (end - begin);
    CHECK(segment.acceleration.x() == Approx(0.5 + 2.0 * mean).margin(1e-12));
    CHECK(segment.acceleration.y() == 0.0);
    CHECK(segment.acceleration.z() == Approx(mean).margin(1e-12));
  }
}

TEST_CASE("sampled_wave: the samples cover the duration without gaps", "[validate][sampled_wave]") {
  const Acceleration acceleration = sampled({Vec3::UnitY(), {}}, 60.0, 1000.0);
  REQUIRE(acceleration.segments.size() == 60000);
  CHECK(acceleration.end_time() == Approx(60.0).epsilon(1e-14));
  const std::vector<Phase> phases = phases_of(acceleration, acceleration.end_time());
  CHECK(phases.size() == 60000);
}

TEST_CASE("sampled_wave: noise has the power that is asked for, and its seed decides it", "[validate][sampled_wave]") {
  const Vec3 wanted(0.3, 0.2, 0.0);
  const Acceleration acceleration = sampled({Vec3::Zero(), noise(5, 32, 1.0, 40.0, wanted)}, 200.0, 500.0);
  Vec3 squares = Vec3::Zero();
  for (const Segment& segment : acceleration.segments) squares += segment.acceleration.cwiseAbs2();
  const Vec3 found = (squares / static_cast<double>(acceleration.segments.size())).cwiseSqrt();
  CAPTURE(found.transpose());
  CHECK(found.x() == Approx(wanted.x()).epsilon(0.05));
  CHECK(found.y() == Approx(wanted.y()).epsilon(0.05));
  CHECK(found.z() == 0.0);
  const std::vector<Wave> again = noise(5, 32, 1.0, 40.0, wanted);
  const std::vector<Wave> other = noise(6, 32, 1.0, 40.0, wanted);
  CHECK(noise(5, 32, 1.0, 40.0, wanted).front().phase == again.front().phase);
  CHECK(again.front().phase != other.front().phase);
  const auto outside = [](const Wave& wave) { return wave.frequency < 1.0 || wave.frequency > 40.0; };
  CHECK(std::none_of(again.begin(), again.end(), outside));
}

TEST_CASE("sampled_wave: the largest use is that of friction or of balance, whichever is more",
          "[validate][sampled_wave]") {
  Acceleration acceleration;
  acceleration.segments = {{0.0, 0.1, Vec3(3.0, 4.0, 0.0)}, {0.1, 0.1, Vec3(-2.0, 0.0, -5.0)}};
  // 5 / (0.8 · 10) in the first sample, 2 / (0.8 · 5) in the second.
  CHECK(largest_use(acceleration, {0.8, 9.0, 9.0}, 10.0) == Approx(0.625));
  // 4 / (0.4 · 10) along y, and 2 / (0.5 · 5) along x in the second sample.
  CHECK(largest_use(acceleration, {9.0, 0.5, 0.4}, 10.0) == Approx(1.0));
  CHECK(largest_use(acceleration, {9.0, 0.5, 4.0}, 10.0) == Approx(0.8));
}

}  // namespace sampled_wave_test
