#pragma once

#include "core/settings.hpp"

namespace holdfast {

/// What kind of thing a body's surface belongs to.
enum class SurfaceKind { box, floor, wall, ground };

/// The surface of a body, hung on it as its user pointer: what Bullet's contact callbacks need. Belongs to the
/// world of the body.
struct Surface {
  SurfaceKind kind = SurfaceKind::box;
  double friction = 0.0;
  double restitution = 0.0;
  const ContactSettings* contact = nullptr;
};

/// Makes Bullet ask us for the friction and restitution of every pair (its callbacks are global to the library).
/// Friction is the product of both sides as in Bullet itself, or given by the kind of pair. Restitution of a box
/// and the container is the box's, of two boxes the smaller one: the side that dissipates more decides.
void install_contact_laws();

}  // namespace holdfast
