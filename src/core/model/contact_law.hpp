#pragma once

#include "core/model/settings.hpp"

namespace holdfast::internal {

/// What kind of thing a surface belongs to.
enum class SurfaceKind { box, floor, wall, ground };

/// What a body's surface adds to a contact.
struct Surface {
  SurfaceKind kind = SurfaceKind::box;
  double friction = 0.0;  ///< one side of a product
  double restitution = 0.0;
};

/// Coefficient of friction between two surfaces: the product of both sides, or given by the kind of pair. On the
/// ground it is always the product.
double friction_of_pair(const ContactSettings& contact, const Surface& a, const Surface& b);

/// Coefficient of restitution between two surfaces: of a box and the container the box's, of two boxes the smaller
/// one, because the side that dissipates more decides.
double restitution_of_pair(const Surface& a, const Surface& b);

}  // namespace holdfast::internal
