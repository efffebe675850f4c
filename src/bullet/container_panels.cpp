#include "bullet/container_panels.hpp"

#include <algorithm>
#include <array>

namespace holdfast {

std::vector<Panel> container_panels(const ContainerSettings& container, double thickness) {
  struct Side {
    const char* name;
    int axis;
    bool far;
  };
  constexpr std::array<Side, 6> kSides = {{{"floor", 2, false},
                                           {"front", 0, false},
                                           {"rear", 0, true},
                                           {"left", 1, false},
                                           {"right", 1, true},
                                           {"roof", 2, true}}};
  const auto is_open = [&](const Side& side) {
    const auto& open = container.open_sides;
    return std::find(open.begin(), open.end(), side.name) != open.end();
  };
  // Panels reach over the edges that they share with others; towards an open side they end where it begins.
  Vec3 from = Vec3::Constant(-thickness);
  Vec3 to = container.size + Vec3::Constant(thickness);
  for (const Side& side : kSides) {
    if (is_open(side)) (side.far ? to : from)[side.axis] = side.far ? container.size[side.axis] : 0.0;
  }
  std::vector<Panel> panels;
  for (const Side& side : kSides) {
    if (is_open(side)) continue;
    Vec3 low = from;
    Vec3 high = to;
    low[side.axis] = side.far ? container.size[side.axis] : -thickness;
    high[side.axis] = side.far ? container.size[side.axis] + thickness : 0.0;
    const SurfaceKind kind = side.axis == 2 && !side.far ? SurfaceKind::floor : SurfaceKind::wall;
    panels.push_back({0.5 * (low + high), 0.5 * (high - low), kind});
  }
  return panels;
}

}  // namespace holdfast
