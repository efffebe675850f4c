#include "core/model/container_panels.hpp"

#include <algorithm>

#include "core/model/container_sides.hpp"

namespace holdfast::internal {

std::vector<Panel> container_panels(const ContainerSettings& container, double thickness) {
  const std::vector<ContainerSide> closed = closed_sides(container);
  const auto is_open = [&](int axis, bool far) {
    return std::none_of(closed.begin(), closed.end(),
                        [&](const ContainerSide& side) { return side.axis == axis && side.far == far; });
  };
  // Panels extend over the edges that they have in common with others; at an open side they end at the edge.
  Vec3 from = Vec3::Constant(-thickness);
  Vec3 to = container.size + Vec3::Constant(thickness);
  for (int axis = 0; axis < 3; ++axis) {
    if (is_open(axis, false)) from[axis] = 0.0;
    if (is_open(axis, true)) to[axis] = container.size[axis];
  }
  std::vector<Panel> panels;
  for (const ContainerSide& side : closed) {
    Vec3 low = from;
    Vec3 high = to;
    low[side.axis] = side.far ? container.size[side.axis] : -thickness;
    high[side.axis] = side.far ? container.size[side.axis] + thickness : 0.0;
    panels.push_back({side.index, 0.5 * (low + high), 0.5 * (high - low), side.kind});
  }
  return panels;
}

}  // namespace holdfast::internal
