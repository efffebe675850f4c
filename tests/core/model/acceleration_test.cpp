#include "core/model/acceleration.hpp"

#include <catch2/catch.hpp>

using namespace holdfast;

namespace {

/// Segments of (start, duration, acceleration along x).
Motion motion_of(const std::vector<Vec3>& segments) {
  Motion motion;
  for (const Vec3& s : segments) motion.segments.push_back({s[0], s[1], Vec3(s[2], 0, 0), 0});
  return motion;
}

/// Phases as (begin, end, acceleration along x).
std::vector<Vec3> phases(const Motion& motion, double end) {
  std::vector<Vec3> rows;
  for (const Phase& phase : phases_of(motion, end)) rows.emplace_back(phase.begin, phase.end, phase.acceleration.x());
  return rows;
}

}  // namespace

TEST_CASE("motion: phases cover the time without gap; gaps and the rest are at rest", "[core][motion]") {
  const Motion motion = motion_of({{1, 2, 5}, {4, 1, -5}});
  CHECK(phases(motion, 6) == std::vector<Vec3>{{0, 1, 0}, {1, 3, 5}, {3, 4, 0}, {4, 5, -5}, {5, 6, 0}});
}

TEST_CASE("motion: phases are cut at the end of the simulated time", "[core][motion]") {
  const Motion motion = motion_of({{0, 2, 5}, {2, 1, -5}});
  CHECK(phases(motion, 1.5) == std::vector<Vec3>{{0, 1.5, 5}});
  CHECK(phases(motion, 2) == std::vector<Vec3>{{0, 2, 5}});
  CHECK(phases(motion, 0).empty());
  CHECK(phases(Motion{}, 3) == std::vector<Vec3>{{0, 3, 0}});
}

TEST_CASE("motion: rounding of decimal times makes no phase of its own", "[core][motion]") {
  const Motion motion = motion_of({{0, 0.1, 1}, {0.1, 0.2, 2}, {0.3, 0.1, 3}});
  REQUIRE(0.1 + 0.2 != 0.3);
  CHECK(phases(motion, 0.4).size() == 3);
}

TEST_CASE("motion: end of the last segment", "[core][motion]") {
  CHECK(Motion{}.end_time() == 0.0);
  CHECK(motion_of({{0, 1, 0}, {5, 0.5, 1}}).end_time() == 5.5);
}

TEST_CASE("motion: last change of the acceleration", "[core][motion]") {
  CHECK(last_change(Motion{}) == 0.0);
  CHECK(last_change(motion_of({{0, 1, 0}, {1, 2, 0}})) == 0.0);
  CHECK(last_change(motion_of({{0, 1, 0}, {1, 0.3, 1}})) == Approx(1.3));
  CHECK(last_change(motion_of({{0, 0.5, 0}, {0.5, 1, 7.848}, {1.5, 1.5, 0}})) == 1.5);
  CHECK(last_change(motion_of({{0, 2, 3}, {2, 2, 3}})) == 4.0);
}
