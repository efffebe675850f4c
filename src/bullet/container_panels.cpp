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
  std::vector<Panel> panels;
  for (const Side& side : kSides) {
    const auto& open = container.open_sides;
    if (std::find(open.begin(), open.end(), side.name) != open.end()) continue;
    Panel panel{0.5 * container.size, 0.5 * container.size + Vec3::Constant(thickness)};
    panel.half_extents[side.axis] = 0.5 * thickness;
    panel.centre[side.axis] = side.far ? container.size[side.axis] + 0.5 * thickness : -0.5 * thickness;
    panel.kind = side.axis == 2 && !side.far ? SurfaceKind::floor : SurfaceKind::wall;
    panels.push_back(panel);
  }
  return panels;
}

}  // namespace holdfast
