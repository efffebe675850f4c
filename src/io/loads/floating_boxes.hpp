#pragma once

#include <cstddef>

#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Boxes that must stand on something, and how many of them do not.
struct FloatingBoxes {
  std::size_t floating = 0;
  std::size_t all = 0;

  FloatingBoxes& operator+=(const FloatingBoxes& other) {
    floating += other.floating;
    all += other.all;
    return *this;
  }
};

/// Counts the boxes of a load that float: whose bottom is neither on the floor nor on the top of a box or wall below
/// with which it has an area in common, within a centimetre, which rounding and play of packing programs leave. Fixed
/// boxes may float, and are not counted.
FloatingBoxes count_floating(const Layout& layout, const Settings& settings);

}  // namespace holdfast::internal
