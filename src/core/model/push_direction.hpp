#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "core/base/vector.hpp"

namespace holdfast::internal {

/// What margins and norms call 1 g, m/s².
inline constexpr double kStandardGravity = 9.81;

/// A direction in which the load is pushed. The acceleration of the container is opposite.
struct MarginDirection {
  std::string_view name;
  std::array<double, 3> push;  ///< unit vector, container frame
};

/// The directions of margins, in the order of all tables.
inline constexpr std::array<MarginDirection, 4> kMarginDirections = {
    {{"front", {-1, 0, 0}}, {"rear", {1, 0, 0}}, {"left", {0, -1, 0}}, {"right", {0, 1, 0}}}};
inline constexpr std::size_t kDirectionCount = kMarginDirections.size();

/// The acceleration of the container that pushes the load in a direction.
/// @param size g
inline Vec3 push_acceleration(std::size_t direction, double size) {
  const std::array<double, 3>& push = kMarginDirections.at(direction).push;
  return -size * kStandardGravity * Vec3(push[0], push[1], push[2]);
}

}  // namespace holdfast::internal
