#include "io/loads/floating_boxes.hpp"

#include <algorithm>
#include <vector>

#include "core/model/container_panels.hpp"

namespace holdfast::internal {

namespace {

/// Gap beneath a box up to which it stands, m.
constexpr double kMostGap = 0.01;

bool share_area(const Box& a, const Box& b) {
  return (a.corner_min.head<2>().cwiseMax(b.corner_min.head<2>()).array() <
          a.corner_max.head<2>().cwiseMin(b.corner_max.head<2>()).array())
      .all();
}

}  // namespace

FloatingBoxes count_floating(const Layout& layout, const Settings& settings) {
  const std::vector<Box>& boxes = layout.boxes;
  std::vector<Box> walls;  // on which boxes may stand
  for (const Panel& panel : container_panels(container_of(settings, layout), kWallThickness))
    if (panel.ends) walls.push_back({.corner_min = panel.low(), .corner_max = panel.high()});
  std::vector<const Box*> by_top;
  for (const Box& wall : walls) by_top.push_back(&wall);
  for (const Box& box : boxes) by_top.push_back(&box);
  std::sort(by_top.begin(), by_top.end(),
            [](const Box* a, const Box* b) { return a->corner_max.z() < b->corner_max.z(); });
  const auto stands = [&](const Box& box) {
    const double bottom = box.corner_min.z();
    if (bottom <= kMostGap) return true;
    for (auto top = std::lower_bound(by_top.begin(), by_top.end(), bottom - kMostGap,
                                     [](const Box*const below, double least) { return below->corner_max.z() < least; });
         top != by_top.end() && (*top)->corner_max.z() <= bottom + kMostGap; ++top)
      if (*top != &box && share_area(**top, box)) return true;
    return false;
  };
  FloatingBoxes count;
  for (const Box& box : boxes) {
    if (properties_of(settings, box).fixed) continue;
    ++count.all;
    if (!stands(box)) ++count.floating;
  }
  return count;
}

}  // namespace holdfast::internal
