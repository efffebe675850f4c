#include "analyses/walls/wall_limits.hpp"

#include <algorithm>
#include <limits>

namespace holdfast::internal {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The test forces of a norm: shares of the payload's weight, and what the force need not exceed, N.
struct TestForces {
  double front, rear, side;
  double front_most = std::numeric_limits<double>::infinity();
  double rear_most = std::numeric_limits<double>::infinity();
};

TestForces test_forces(WallNorm norm) {
  switch (norm) {
    case WallNorm::en12642_l:
      return {.front = 0.4, .rear = 0.25, .side = 0.3, .front_most = 50e3, .rear_most = 31e3};
    case WallNorm::en12642_xl:
      return {.front = 0.5, .rear = 0.3, .side = 0.4};
    case WallNorm::en283:
      return {.front = 0.4, .rear = 0.4, .side = 0.3};
    case WallNorm::iso_container:
      return {.front = 0.4, .rear = 0.4, .side = 0.6};
  }
  return {kNone, kNone, kNone};
}

}  // namespace

std::array<double, kPushedCount> wall_limits(std::optional<WallNorm> norm, double payload) {
  std::array<double, kPushedCount> limits;
  limits.fill(kNone);
  if (!norm) return limits;
  const TestForces forces = test_forces(*norm);
  limits[1] = std::min(forces.front * payload, forces.front_most);
  limits[2] = std::min(forces.rear * payload, forces.rear_most);
  limits[3] = limits[4] = forces.side * payload;  // left and right
  return limits;
}

}  // namespace holdfast::internal
