#include "bullet/surface.hpp"

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <algorithm>
#include <mutex>

#include "bullet/bullet_number.hpp"

namespace holdfast {

namespace {

const Surface& surface_of(const btCollisionObject* body) {
  return *static_cast<const Surface*>(body->getUserPointer());
}

bool is_box(const Surface& surface) { return surface.kind == SurfaceKind::box; }

btScalar pair_friction(const btCollisionObject* first, const btCollisionObject* second) {
  const Surface& a = surface_of(first);
  const Surface& b = surface_of(second);
  const bool touches_ground = a.kind == SurfaceKind::ground || b.kind == SurfaceKind::ground;
  const ContactSettings& contact = *a.contact;
  if (contact.friction_model == FrictionModel::product || touches_ground) return to_bullet(a.friction * b.friction);
  if (is_box(a) && is_box(b)) return to_bullet(contact.box_box);
  const Surface& container = is_box(a) ? b : a;
  return to_bullet(container.kind == SurfaceKind::floor ? contact.box_floor : contact.box_wall);
}

btScalar pair_restitution(const btCollisionObject* first, const btCollisionObject* second) {
  const Surface& a = surface_of(first);
  const Surface& b = surface_of(second);
  if (is_box(a) && is_box(b)) return to_bullet(std::min(a.restitution, b.restitution));
  return to_bullet(is_box(a) ? a.restitution : b.restitution);
}

}  // namespace

void install_contact_laws() {
  // Once a plug-in: other engines may be at work when one more is made.
  static std::once_flag installed;
  std::call_once(installed, [] {
    gCalculateCombinedFrictionCallback = pair_friction;
    gCalculateCombinedRestitutionCallback = pair_restitution;
  });
}

}  // namespace holdfast
