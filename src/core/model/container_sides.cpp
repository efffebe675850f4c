#include "core/model/container_sides.hpp"

#include <algorithm>
#include <array>

namespace holdfast {

double side_play(SurfaceKind kind, double gap) {
  return kind == SurfaceKind::floor ? 0.0 : std::max(0.0, kLeastPlay - gap);
}

std::vector<ContainerSide> closed_sides(const ContainerSettings& container) {
  struct NamedSide {
    const char* name;
    ContainerSide side;
  };
  constexpr std::array<NamedSide, 6> kSides = {{{"floor", {2, false, SurfaceKind::floor}},
                                                {"front", {0, false, SurfaceKind::wall}},
                                                {"rear", {0, true, SurfaceKind::wall}},
                                                {"left", {1, false, SurfaceKind::wall}},
                                                {"right", {1, true, SurfaceKind::wall}},
                                                {"roof", {2, true, SurfaceKind::wall}}}};
  std::vector<ContainerSide> closed;
  for (const NamedSide& named : kSides) {
    const auto& open = container.open_sides;
    if (std::find(open.begin(), open.end(), named.name) == open.end()) closed.push_back(named.side);
  }
  return closed;
}

}  // namespace holdfast
