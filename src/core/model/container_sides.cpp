#include "core/model/container_sides.hpp"

#include <algorithm>

namespace holdfast::internal {

bool can_be_open(std::string_view side) {
  return std::any_of(kContainerSides.begin() + 1, kContainerSides.end(),
                     [&](const ContainerSide& known) { return known.name == side; });
}

bool is_open(const ContainerSettings& container, const ContainerSide& side) {
  const auto& open = container.open_sides;
  return std::find(open.begin(), open.end(), side.name) != open.end();
}

void close_drop_sides(ContainerShape& container) {
  for (const DropSide& drop : container.drop_sides) std::erase(container.open_sides, drop.side);
}

double wall_height(const ContainerSettings& container, const ContainerSide& wall) {
  if (is_open(container, wall)) return 0.0;
  for (const DropSide& drop : container.drop_sides)
    if (drop.side == wall.name) return std::min(drop.height, container.size.z());
  return container.size.z();
}

bool is_above_drop_side(const ContainerSettings& container, const ContainerSide& side, double bottom) {
  const double height = wall_height(container, side);
  return side.axis != 2 && height < container.size.z() && bottom >= height;
}

bool has_opening(const ContainerSettings& container) {
  return std::any_of(kContainerSides.begin() + 1, kContainerSides.end(),
                     [&](const ContainerSide& side) { return wall_height(container, side) < container.size.z(); });
}

std::vector<ContainerSide> closed_sides(const ContainerSettings& container) {
  std::vector<ContainerSide> closed;
  for (const ContainerSide& side : kContainerSides)
    if (!is_open(container, side)) closed.push_back(side);
  return closed;
}

}  // namespace holdfast::internal
