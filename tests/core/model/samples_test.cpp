#include "core/model/samples.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

namespace samples_test {

using namespace holdfast::internal;

namespace {

constexpr double kMillisecond = 1e-3;

/// A sine of 1 Hz and 5 m/s² along x, in samples of a millisecond, with 1 m/s² along z.
std::vector<Phase> sine(int samples) {
  std::vector<Phase> phases;
  for (int i = 0; i < samples; ++i) {
    const double middle = kMillisecond * (i + 0.5);
    phases.push_back(
        {kMillisecond * i, kMillisecond * (i + 1), Vec3(5.0 * std::sin(2.0 * std::numbers::pi * middle), 0, 1)});
  }
  return phases;
}

/// The change of the velocity of what accelerates so, m/s.
Vec3 velocity_change(std::span<const Phase> phases) {
  Vec3 change = Vec3::Zero();
  for (const Phase& phase : phases) change += (phase.end - phase.begin) * phase.acceleration;
  return change;
}

}  // namespace

TEST_CASE("samples: those far shorter than a step are grouped, with their mean", "[core][samples]") {
  const std::vector<Phase> samples = sine(1010);
  const std::vector<Phase> groups = grouped(samples, 1.0 / 60.0);
  // 16 whole samples fit into a step of 16.7 ms.
  REQUIRE(groups.size() == 64);
  CHECK(groups.front().begin == samples.front().begin);
  CHECK(groups.back().end == samples.back().end);
  std::size_t taken = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (i > 0) CHECK(groups[i].begin == groups[i - 1].end);
    REQUIRE(groups[i].samples.size() == (i + 1 < groups.size() ? 16 : 2));
    CHECK(groups[i].samples.front().begin == samples[taken].begin);
    CHECK(groups[i].samples.back().acceleration == samples[taken + groups[i].samples.size() - 1].acceleration);
    CHECK(groups[i].acceleration.z() == 1.0);
    CHECK(((groups[i].end - groups[i].begin) * groups[i].acceleration - velocity_change(groups[i].samples)).norm() <
          1e-15);
    taken += groups[i].samples.size();
  }
  CHECK(taken == samples.size());
}

TEST_CASE("samples: those that are not far shorter than a step stay phases of their own", "[core][samples]") {
  for (const double step : {1e-3, 3e-3, 4e-3}) {
    const std::vector<Phase> groups = grouped(sine(100), step);
    REQUIRE(groups.size() == 100);
    for (const Phase& group : groups) CHECK(group.samples.empty());
  }
  CHECK(grouped(sine(100), 5e-3).size() == 20);
  CHECK(grouped({}, 1.0).empty());
}

TEST_CASE("samples: a long phase is in no group, and one short phase between long ones is none", "[core][samples]") {
  std::vector<Phase> phases = {{-1, 0, Vec3(7, 0, 0)}};
  for (const Phase& phase : sine(20)) phases.push_back(phase);
  phases.push_back({0.02, 1, Vec3(8, 0, 0)});
  phases.push_back({1, 1.001, Vec3(3, 0, 0)});
  const std::vector<Phase> groups = grouped(phases, 0.016);
  REQUIRE(groups.size() == 5);
  const std::vector<std::size_t> sizes = {0, 16, 4, 0, 0};
  for (std::size_t i = 0; i < groups.size(); ++i) CHECK(groups[i].samples.size() == sizes[i]);
  CHECK(groups[0].acceleration.x() == 7.0);
  CHECK(groups[3].acceleration.x() == 8.0);
  CHECK(groups[4].acceleration.x() == 3.0);
}

TEST_CASE("samples: the mean of an interval that begins and ends within samples", "[core][samples]") {
  const std::vector<Phase> phases = {{0, 1, Vec3(1, 0, 0)}, {1, 2, Vec3(3, 0, 0)}, {2, 3, Vec3(5, 0, 0)}};
  const Phase mean = mean_of(phases, 0.5, 2.25);
  CHECK(mean.begin == 0.5);
  CHECK(mean.end == 2.25);
  CHECK(mean.acceleration.x() == Approx((0.5 * 1 + 1 * 3 + 0.25 * 5) / 1.75));
  CHECK(mean_of(phases, 1.25, 1.5).acceleration.x() == 3.0);
}

}  // namespace samples_test
