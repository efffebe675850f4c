#include "bullet/surface.hpp"

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <mutex>

#include "bullet/bullet_number.hpp"

namespace holdfast::internal {

namespace {

const BodySurface& surface_of(const btCollisionObject* body) {
  return *static_cast<const BodySurface*>(body->getUserPointer());
}

btScalar pair_friction(const btCollisionObject* first, const btCollisionObject* second) {
  const BodySurface& a = surface_of(first);
  return to_bullet(friction_of_pair(*a.contact, a, surface_of(second)));
}

btScalar pair_restitution(const btCollisionObject* first, const btCollisionObject* second) {
  return to_bullet(restitution_of_pair(surface_of(first), surface_of(second)));
}

}  // namespace

void install_contact_laws() {
  // Once per plug-in: other engines may be in use when another one is created.
  static std::once_flag installed;
  std::call_once(installed, [] {
    gCalculateCombinedFrictionCallback = pair_friction;
    gCalculateCombinedRestitutionCallback = pair_restitution;
  });
}

}  // namespace holdfast::internal
