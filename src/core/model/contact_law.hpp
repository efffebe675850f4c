#pragma once

#include "core/model/settings.hpp"

namespace holdfast::internal {

/// The kind of body that a surface belongs to.
enum class SurfaceKind { box, floor, wall, ground };

/// The properties of a body's surface in a contact.
struct Surface {
  SurfaceKind kind = SurfaceKind::box;
  double friction = 0.0;  ///< one factor of a product
  double restitution = 0.0;
};

/// Coefficient of friction between two surfaces: the product of both sides, or the value for the kind of pair. On the
/// ground it is always the product.
double friction_of_pair(const ContactSettings& contact, const Surface& a, const Surface& b);

/// Coefficient of restitution between two surfaces: between a box and the container that of the box; between two boxes
/// the smaller one, because the surface that dissipates more energy decides.
double restitution_of_pair(const Surface& a, const Surface& b);

}  // namespace holdfast::internal
