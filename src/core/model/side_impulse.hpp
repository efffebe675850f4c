#pragma once

#include <array>
#include <cstddef>

#include "core/base/vector.hpp"
#include "core/model/container_sides.hpp"

namespace holdfast::internal {

inline constexpr std::size_t kSideCount = kContainerSides.size();

/// The part of a vector that points out of the container through a side.
inline double outward(std::size_t side, const Vec3& vector) {
  const ContainerSide& where = kContainerSides.at(side);
  return where.far ? vector[where.axis] : -vector[where.axis];
}

/// What the boxes do to a side of the container in a stretch of time. Contacts and stretches add up.
struct SideImpulse {
  Vec3 impulse = Vec3::Zero();         ///< on the side, container frame, N s
  Vec3 weighted_point = Vec3::Zero();  ///< sum over the contacts of outward impulse times place, N s m
};

/// One entry per side, in the order of `kContainerSides`.
using SideImpulses = std::array<SideImpulse, kSideCount>;

/// Adds the impulse of a contact on a side.
/// @param impulse on the side, N s
/// @param point   of the contact, m
inline void add_contact(SideImpulses& sides, std::size_t side, const Vec3& impulse, const Vec3& point) {
  sides.at(side).impulse += impulse;
  sides.at(side).weighted_point += outward(side, impulse) * point;
}

}  // namespace holdfast::internal
