#include "core/model/contact_law.hpp"

#include <algorithm>

namespace holdfast::internal {

namespace {

bool is_box(const Surface& surface) { return surface.kind == SurfaceKind::box; }

}  // namespace

double friction_of_pair(const ContactSettings& contact, const Surface& a, const Surface& b) {
  const bool touches_ground = a.kind == SurfaceKind::ground || b.kind == SurfaceKind::ground;
  if (contact.friction_model == FrictionModel::product || touches_ground) return a.friction * b.friction;
  if (is_box(a) && is_box(b)) return contact.box_box;
  const Surface& container = is_box(a) ? b : a;
  return container.kind == SurfaceKind::floor ? contact.box_floor : contact.box_wall;
}

double restitution_of_pair(const Surface& a, const Surface& b) {
  if (is_box(a) && is_box(b)) return std::min(a.restitution, b.restitution);
  return is_box(a) ? a.restitution : b.restitution;
}

}  // namespace holdfast::internal
