#include "analyses/walls/wall_limits.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace wall_limits_test {

using namespace holdfast::internal;

namespace {

/// Limits of front, rear, left and right, N.
void check_limits(WallNorm norm, double payload, const std::array<double, 4>& expected) {
  const std::array<double, kPushedCount> limits = wall_limits(norm, payload);
  CAPTURE(static_cast<int>(norm), payload);
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(limits.at(i + 1) == Approx(expected.at(i)));
  CHECK(std::isnan(limits[0]));
  CHECK(std::isnan(limits[5]));
}

}  // namespace

TEST_CASE("wall_limits: shares of the payload as the norms have them, and caps of EN 12642 L", "[core][walls]") {
  check_limits(WallNorm::en12642_l, 100e3, {40e3, 25e3, 30e3, 30e3});
  check_limits(WallNorm::en12642_l, 240e3, {50e3, 31e3, 72e3, 72e3});
  check_limits(WallNorm::en12642_xl, 240e3, {120e3, 72e3, 96e3, 96e3});
  check_limits(WallNorm::en283, 240e3, {96e3, 96e3, 72e3, 72e3});
  check_limits(WallNorm::iso_container, 240e3, {96e3, 96e3, 144e3, 144e3});
}

TEST_CASE("wall_limits: without a norm there are none", "[core][walls]") {
  for (const double limit : wall_limits(std::nullopt, 100e3)) CHECK(std::isnan(limit));
}

}  // namespace wall_limits_test
