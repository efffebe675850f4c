#include "core/model/acceleration.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace holdfast::internal;

namespace {

/// Segments of (start, duration, acceleration along x).
Acceleration acceleration_of(const std::vector<Vec3>& segments) {
  Acceleration acceleration;
  for (const Vec3& s : segments) acceleration.segments.push_back({s[0], s[1], Vec3(s[2], 0, 0), 0});
  return acceleration;
}

/// Phases as (begin, end, acceleration along x).
std::vector<Vec3> phases(const Acceleration& acceleration, double end) {
  std::vector<Vec3> rows;
  for (const Phase& phase : phases_of(acceleration, end))
    rows.emplace_back(phase.begin, phase.end, phase.acceleration.x());
  return rows;
}

/// A sine of 1 Hz and 5 m/s², in samples of a millisecond.
std::vector<Phase> sine(int samples) {
  std::vector<Phase> phases;
  for (int i = 0; i < samples; ++i) {
    const double middle = 1e-3 * (i + 0.5);
    phases.push_back({1e-3 * i, 1e-3 * (i + 1), Vec3(5.0 * std::sin(2.0 * std::numbers::pi * middle), 0, 1)});
  }
  return phases;
}

/// Where a free container is at the end, from rest, m.
Vec3 path(const std::vector<Phase>& phases) {
  Vec3 velocity = Vec3::Zero(), position = Vec3::Zero();
  for (const Phase& phase : phases) {
    const double duration = phase.end - phase.begin;
    position += duration * (velocity + 0.5 * duration * phase.acceleration);
    velocity += duration * phase.acceleration;
  }
  return position;
}

}  // namespace

TEST_CASE("acceleration: phases cover the time without gap, with zero outside segments", "[core][acceleration]") {
  const Acceleration acceleration = acceleration_of({{1, 2, 5}, {4, 1, -5}});
  CHECK(phases(acceleration, 6) == std::vector<Vec3>{{0, 1, 0}, {1, 3, 5}, {3, 4, 0}, {4, 5, -5}, {5, 6, 0}});
}

TEST_CASE("acceleration: phases are cut at the end of the simulated time", "[core][acceleration]") {
  const Acceleration acceleration = acceleration_of({{0, 2, 5}, {2, 1, -5}});
  CHECK(phases(acceleration, 1.5) == std::vector<Vec3>{{0, 1.5, 5}});
  CHECK(phases(acceleration, 2) == std::vector<Vec3>{{0, 2, 5}});
  CHECK(phases(acceleration, 0).empty());
  CHECK(phases(Acceleration{}, 3) == std::vector<Vec3>{{0, 3, 0}});
}

TEST_CASE("acceleration: rounding of decimal times adds no phase", "[core][acceleration]") {
  const Acceleration acceleration = acceleration_of({{0, 0.1, 1}, {0.1, 0.2, 2}, {0.3, 0.1, 3}});
  REQUIRE(0.1 + 0.2 != 0.3);
  CHECK(phases(acceleration, 0.4).size() == 3);
}

TEST_CASE("acceleration: end of the last segment", "[core][acceleration]") {
  CHECK(Acceleration{}.end_time() == 0.0);
  CHECK(acceleration_of({{0, 1, 0}, {5, 0.5, 1}}).end_time() == 5.5);
}

TEST_CASE("acceleration: last change of the acceleration", "[core][acceleration]") {
  CHECK(last_change(Acceleration{}) == 0.0);
  CHECK(last_change(acceleration_of({{0, 1, 0}, {1, 2, 0}})) == 0.0);
  CHECK(last_change(acceleration_of({{0, 1, 0}, {1, 0.3, 1}})) == Approx(1.3));
  CHECK(last_change(acceleration_of({{0, 0.5, 0}, {0.5, 1, 7.848}, {1.5, 1.5, 0}})) == 1.5);
  CHECK(last_change(acceleration_of({{0, 2, 3}, {2, 2, 3}})) == 4.0);
}

TEST_CASE("acceleration: samples far shorter than a step are resampled, and the container goes the same way",
          "[core][acceleration]") {
  const std::vector<Phase> samples = sine(1010);
  const std::vector<Phase> steps = resampled(samples, 1.0 / 60.0);
  REQUIRE(steps.size() == 61);
  CHECK(steps.front().begin == samples.front().begin);
  CHECK(steps.back().end == samples.back().end);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    CHECK(steps[i].end - steps[i].begin == Approx(1.01 / 61));
    if (i > 0) CHECK(steps[i].begin == steps[i - 1].end);
    CHECK(steps[i].acceleration.z() == 1.0);
  }
  CHECK((path(steps) - path(samples)).norm() < 1e-3 * path(samples).norm());
  CHECK(path(steps) != path(samples));
}

TEST_CASE("acceleration: samples that are not far shorter than a step stay", "[core][acceleration]") {
  for (const double step : {1e-3, 3e-3, 4e-3}) CHECK(resampled(sine(100), step).size() == 100);
  CHECK(resampled(sine(100), 5e-3).size() < 100);
  CHECK(resampled({}, 1.0).empty());
}

TEST_CASE(
    "acceleration: what lies between longer phases stays where it is alone, and is resampled for itself where not",
    "[core][acceleration]") {
  const std::vector<Phase> one = {{0, 1, Vec3::Zero()}, {1, 1.001, Vec3(3, 0, 0)}, {1.001, 2, Vec3::Zero()}};
  const std::vector<Phase> same = resampled(one, 0.1);
  REQUIRE(same.size() == 3);
  CHECK(same[1].acceleration == one[1].acceleration);
  std::vector<Phase> many = {{-1, 0, Vec3(7, 0, 0)}};
  for (const Phase& phase : sine(100)) many.push_back(phase);
  many.push_back({0.1, 1, Vec3(8, 0, 0)});
  const std::vector<Phase> steps = resampled(many, 0.016);
  REQUIRE(steps.size() == 9);
  CHECK(steps.front().acceleration.x() == 7.0);
  CHECK(steps.back().acceleration.x() == 8.0);
}

TEST_CASE("acceleration: a blow within a step is not averaged away", "[core][acceleration]") {
  std::vector<Phase> samples = sine(100);
  samples[50].acceleration.x() = 300.0;
  samples[51].acceleration.x() = -300.0;
  const std::vector<Phase> steps = resampled(samples, 0.02);
  for (const double blow : {300.0, -300.0})
    CHECK(std::any_of(steps.begin(), steps.end(), [&](const Phase& step) { return step.acceleration.x() == blow; }));
  // The blow alone moves the container by 0.3 mm. Where there is none, steps are long.
  CHECK((path(steps) - path(samples)).norm() < 1e-4);
  CHECK(steps.size() < 20);
}
