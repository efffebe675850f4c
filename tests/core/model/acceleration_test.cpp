#include "core/model/acceleration.hpp"

#include <catch2/catch.hpp>

namespace acceleration_test {

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

}  // namespace acceleration_test
