#pragma once

#include <algorithm>
#include <vector>

#include "core/base/vector.hpp"

namespace holdfast::internal {

/// Where a box is; its extents are positive.
struct BoxExtents {
  Vec3 min, max;
  std::size_t index = 0;  ///< in the layout
};

/// Rounding of differences of coordinates, m; decimal numbers of metres have errors of about 1e-15.
inline constexpr double kExactLength = 1e-9;

/// How far two boxes are in each other along each axis, m; negative when they are apart.
inline Vec3 depths_of(const BoxExtents& a, const BoxExtents& b) {
  return a.max.cwiseMin(b.max) - a.min.cwiseMax(b.min);
}

/// Calls `visit(first, second)` for all pairs of boxes that are in each other by more than `kExactLength` along every
/// axis, by rising places along x. The time is n log n plus the number of pairs whose extents along x overlap.
template <class Visit>
void for_each_overlap(std::vector<BoxExtents>& boxes, Visit visit) {
  std::sort(boxes.begin(), boxes.end(), [](const BoxExtents& a, const BoxExtents& b) {
    return a.min.x() < b.min.x() || (a.min.x() == b.min.x() && a.index < b.index);
  });
  for (auto a = boxes.begin(); a != boxes.end(); ++a) {
    for (auto b = a + 1; b != boxes.end() && b->min.x() < a->max.x(); ++b) {
      const double across =
          (a->max.tail<2>().cwiseMin(b->max.tail<2>()) - a->min.tail<2>().cwiseMax(b->min.tail<2>())).minCoeff();
      if (across > kExactLength && depths_of(*a, *b).x() > kExactLength) visit(*a, *b);  // nearly none
    }
  }
}

}  // namespace holdfast::internal
