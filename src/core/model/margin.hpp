#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
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

/// A number per direction, none of them known yet.
inline constexpr std::array<double, kDirectionCount> kUnknownMargins = {
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// Margins of a layout's replicas, g, one entry per direction; see `margin_spread.hpp`. NaN where they are not known.
struct MarginSpread {
  std::array<double, kDirectionCount> low = kUnknownMargins;     ///< 5 % of the replicas stand less
  std::array<double, kDirectionCount> median = kUnknownMargins;  ///< half of them
  std::array<double, kDirectionCount> high = kUnknownMargins;    ///< 95 % of them
  double cpu_seconds = 0.0;                                      ///< to find them, s
};

/// How much a layout stands in each direction, see `margin_search.hpp`; one entry per direction.
struct LayoutMargins {
  /// Largest constant acceleration that the layout stands, g; NaN where it is not known. Negative: the layout does not
  /// stand under gravity alone, and this is minus the largest acceleration with which a box begins to move.
  std::array<double, kDirectionCount> margin = kUnknownMargins;
  /// The box that goes first where the acceleration is a little larger: position in the layout, from 1; 0 where none
  /// does up to the largest acceleration that is tried.
  std::array<std::uint32_t, kDirectionCount> critical_box = {};
  std::uint32_t trials = 0;  ///< accelerations that were tried, in all directions
  double cpu_seconds = 0.0;  ///< s
  MarginSpread spread;       ///< unknown where replicas were not asked for
};

}  // namespace holdfast::internal
