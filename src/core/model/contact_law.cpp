#include "core/model/contact_law.hpp"

#include <algorithm>

namespace holdfast::internal {

namespace {

bool is_box(const Surface& surface) { return surface.kind == SurfaceKind::box; }

}  // namespace

double friction_of_pair(const ContactSettings& contact, const Surface& a, const Surface& b, double up) {
  const Surface* const upper = up >= kStandsOn ? &b : up <= -kStandsOn ? &a : nullptr;
  if (upper != nullptr && upper->mat) return contact.mat_factor * *upper->mat;
  const bool touches_ground = a.kind == SurfaceKind::ground || b.kind == SurfaceKind::ground;
  if (contact.friction_model == FrictionModel::product || touches_ground) return a.friction * b.friction;
  if (is_box(a) && is_box(b)) return contact.materials.of_boxes(a.material, b.material).value_or(contact.box_box);
  const Surface& box = is_box(a) ? a : b;
  const Surface& container = is_box(a) ? b : a;
  if (container.kind == SurfaceKind::floor) return contact.materials.on_floor(box.material).value_or(contact.box_floor);
  return contact.materials.on_wall(box.material).value_or(contact.box_wall);
}

double restitution_of_pair(const Surface& a, const Surface& b) {
  if (is_box(a) && is_box(b)) return std::min(a.restitution, b.restitution);
  return is_box(a) ? a.restitution : b.restitution;
}

}  // namespace holdfast::internal
