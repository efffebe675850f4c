#pragma once

#include <cstddef>
#include <vector>

#include "core/model/contact_law.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// A side of the container as a solid box outside its inner faces; container frame.
struct Panel {
  std::size_t side = 0;  ///< in `kContainerSides`
  Vec3 centre;           ///< m
  Vec3 half_extents;     ///< m
  SurfaceKind kind = SurfaceKind::wall;
};

/// The sides that are not open, floor first. Each is `thickness` (m) thick, and extends over its edges by as much where
/// the neighbouring side is not open either.
std::vector<Panel> container_panels(const ContainerSettings& container, double thickness);

}  // namespace holdfast::internal
