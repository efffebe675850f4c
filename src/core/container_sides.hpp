#pragma once

#include <vector>

#include "core/contact_law.hpp"
#include "core/settings.hpp"

namespace holdfast {

/// A side of the container that is not open.
struct ContainerSide {
  int axis = 0;      ///< 0, 1, 2: x, y, z, perpendicular to the side
  bool far = false;  ///< at the inner size along the axis, not at 0
  SurfaceKind kind = SurfaceKind::wall;
};

/// The sides that are not open, floor first: floor, front, rear, left, right, roof.
std::vector<ContainerSide> closed_sides(const ContainerSettings& container);

}  // namespace holdfast
