#pragma once

#include <optional>

#include "core/model/settings.hpp"

namespace holdfast::internal {

/// The kind of body that a surface belongs to.
enum class SurfaceKind { box, floor, wall, ground };

/// The properties of a body's surface in a contact.
struct Surface {
  SurfaceKind kind = SurfaceKind::box;
  double friction = 0.0;  ///< one factor of a product
  double restitution = 0.0;
  int material = FrictionTable::kOther;  ///< of a box, in the table of pairs of materials
  std::optional<double> mat = {};        ///< of a box that stands on an anti-slip mat: the coefficient beneath it
};

/// Of a unit vector along a contact's normal the least vertical component with which one body stands on the other:
/// cos 45°, between the sides of boxes and their bottoms.
inline constexpr double kStandsOn = 0.70710678118654757;

/// Coefficient of static friction between two surfaces. Where one body stands on the other with a mat between, it is
/// that of the mat. Else it is the product of both sides, or that of the pair of materials, or of the kind of pair. On
/// the ground without a mat it is always the product.
/// @param up vertical component of the contact's unit normal from a to b
double friction_of_pair(const ContactSettings& contact, const Surface& a, const Surface& b, double up);

/// Coefficient of restitution between two surfaces: between a box and the container that of the box; between two boxes
/// the smaller one, because the surface that dissipates more energy decides.
double restitution_of_pair(const Surface& a, const Surface& b);

}  // namespace holdfast::internal
