#pragma once

#include "core/model/contact_law.hpp"

namespace holdfast::internal {

/// The surface of a body, hung on it as its user pointer: what Bullet's contact callbacks need. Belongs to the
/// world of the body.
struct BodySurface : Surface {
  const ContactSettings* contact = nullptr;
};

/// Makes Bullet ask the contact laws of `contact_law.hpp` for the friction and restitution of every pair (its
/// callbacks are global to the library).
void install_contact_laws();

}  // namespace holdfast::internal
