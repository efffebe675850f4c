#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include "core/model/contact_law.hpp"

namespace holdfast::internal {

/// The surface of a body, for Bullet's contact callbacks: the user pointer of the body. The world of the body owns it.
struct BodySurface : Surface {
  const ContactSettings* contact = nullptr;
};

/// Makes Bullet use the contact laws of `contact_law.hpp` for the friction and restitution of every pair. The callbacks
/// are global in the library.
void install_contact_laws();

/// Contacts of this body may be on its anti-slip mat.
void notice_mat(btCollisionObject& body);

}  // namespace holdfast::internal
