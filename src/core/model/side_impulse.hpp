#pragma once

#include <array>
#include <cstddef>

#include "core/base/vector.hpp"
#include "core/model/container_sides.hpp"

namespace holdfast::internal {

/// How hard a vector presses a side: its part that points out of the container through the side, or down to the ground.
/// Fixed boxes have faces to all directions: for them its length.
inline double pressing(std::size_t side, const Vec3& vector) {
  if (side == kFixedBoxes) return vector.norm();
  if (side == kGround) return -vector.z();
  const ContainerSide& where = kContainerSides.at(side);
  return where.far ? vector[where.axis] : -vector[where.axis];
}

/// What the boxes do to a side of the container in a stretch of time. Contacts and stretches add up.
struct SideImpulse {
  Vec3 impulse = Vec3::Zero();         ///< on the side, container frame, N s
  double pressed = 0.0;                ///< sum over the contacts of `pressing`, N s
  Vec3 weighted_point = Vec3::Zero();  ///< sum over the contacts of `pressing` times place, N s m
};

/// One entry per side, in the order of `kPushedNames`.
using SideImpulses = std::array<SideImpulse, kPushedCount>;

/// Adds the impulse of a contact on a side.
/// @param impulse on the side, N s
/// @param point   of the contact, m
inline void add_contact(SideImpulses& sides, std::size_t side, const Vec3& impulse, const Vec3& point) {
  sides.at(side).impulse += impulse;
  sides.at(side).pressed += pressing(side, impulse);
  sides.at(side).weighted_point += pressing(side, impulse) * point;
}

}  // namespace holdfast::internal
