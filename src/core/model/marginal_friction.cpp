#include "core/model/marginal_friction.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/model/contact_law.hpp"

namespace holdfast::internal {

bool has_marginal_friction(const World& world, const BoxView& boxes, double gravity) {
  double asked = 0.0;
  for (const Segment& segment : world.acceleration->segments) {
    const Vec3& a = segment.acceleration;
    const double vertical = gravity + a.z();
    if (vertical > 0.0) asked = std::max(asked, std::hypot(a.x(), a.y()) / vertical);
  }
  const auto is_marginal = [&](const Surface& a, const Surface& b) {
    return std::abs(friction_of_pair(world.contact, a, b) - asked) <= kMarginalFriction * asked;
  };
  if (asked == 0.0) return false;
  const std::set<double> frictions(boxes.friction.begin(), boxes.friction.end());
  const Surface floor{.kind = SurfaceKind::floor, .friction = world.container_friction};
  for (const double a : frictions) {
    const Surface box{.kind = SurfaceKind::box, .friction = a};
    if (is_marginal(box, floor)) return true;
    for (const double b : frictions)
      if (boxes.friction.size() > 1 && is_marginal(box, {.kind = SurfaceKind::box, .friction = b})) return true;
  }
  return false;
}

}  // namespace holdfast::internal
