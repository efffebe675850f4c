#include "bullet/surface.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
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
  return to_bullet(friction_of_pair(*a.contact, a, surface_of(second), 0.0));
}

/// Gives a new contact point the friction of the mat between two bodies, which depends on its normal: the callback for
/// pairs does not have it.
bool add_mat(btManifoldPoint& point, const btCollisionObjectWrapper* first, int, int,
             const btCollisionObjectWrapper* second, int, int) {
  const BodySurface& a = surface_of(first->getCollisionObject());
  const BodySurface& b = surface_of(second->getCollisionObject());
  // Bullet's normal points from the second body to the first.
  point.m_combinedFriction = to_bullet(friction_of_pair(*a.contact, a, b, -point.m_normalWorldOnB.z()));
  return true;
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
    gContactAddedCallback = add_mat;
  });
}

void notice_mat(btCollisionObject& body) {
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
}

}  // namespace holdfast::internal
