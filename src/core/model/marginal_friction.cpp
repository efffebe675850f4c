#include "core/model/marginal_friction.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/model/contact_law.hpp"

namespace holdfast::internal {

bool has_marginal_friction(const World& world, const BoxView& boxes, double gravity) {
  double asked = 0.0;
  for (const Segment& segment : world.acceleration->segments) {
    const Vec3& a = segment.acceleration;
    const double vertical = gravity + a.z();
    if (vertical > 0.0) asked = std::max(asked, std::hypot(a.x(), a.y()) / vertical);
  }
  if (asked == 0.0) return false;
  const auto is_marginal = [&](const Surface& below, const Surface& above, double up) {
    return std::abs(friction_of_pair(world.contact, below, above, up) - asked) <= kMarginalFriction * asked;
  };
  const auto order = [](const Surface& a, const Surface& b) {
    return std::tie(a.friction, a.material, a.mat) < std::tie(b.friction, b.material, b.mat);
  };
  std::map<Surface, std::size_t, decltype(order)> boxes_with(order);
  for (const Surface& surface : boxes.surface) ++boxes_with[surface];
  const Surface floor{.kind = SurfaceKind::floor, .friction = world.container.friction};
  for (const auto& [above, count] : boxes_with) {
    if (is_marginal(floor, above, 1.0)) return true;
    for (const auto& [below, others] : boxes_with)
      if ((&below != &above || count > 1) && is_marginal(below, above, 1.0)) return true;
  }
  return false;
}

}  // namespace holdfast::internal
