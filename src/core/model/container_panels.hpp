#pragma once

#include <cstddef>
#include <vector>

#include "core/model/contact_law.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// A side of the container, or the ground beneath it, as a solid box outside its inner face; container frame.
struct Panel {
  std::size_t side = 0;  ///< in `kPushedNames`
  Vec3 normal;           ///< of the inner face, unit, into the container
  double offset = 0.0;   ///< of the inner face: normal · x there, m
  Vec3 centre;           ///< m
  Vec3 half_extents;     ///< m
  Surface surface;
  /// Boxes can get round its edges. If not, it is to them what the half-space beyond its inner face is.
  bool ends = false;

  Vec3 low() const { return centre - half_extents; }
  Vec3 high() const { return centre + half_extents; }
};

/// Thickness of the walls and the roof of a container that boxes can get out of, m: about that of a drop side. A box
/// that has tipped over a wall falls beyond it.
inline constexpr double kWallThickness = 0.05;

/// How far the ground and a floor without end reach, m: farther than boxes slide.
inline constexpr double kEndless = 1000.0;

/// The sides that are not open, floor first, and the ground, if there is one.
///
/// Panels of a closed container are `thickness` (m) thick, and extend by as much over the edges that they share. If any
/// side is open or low, walls stand on the ground, are `kWallThickness` thick, and end where the neighbouring side is
/// open; the floor is a block down to the ground under the walls and the inside, and the ground is `thickness` thick.
std::vector<Panel> container_panels(const ContainerSettings& container, double thickness);

/// How far each panel is moved back for each box, so that none is clamped between sides: up to `kLeastPlay` at the roof
/// and up to `kWallPlay` at a wall, where boxes also touch the opposite wall. One wall alone clamps nothing.
/// @param gaps of each panel to each box at the start, m; infinite where the box is not beside the panel
/// @returns m; one row per panel, one number per box
std::vector<std::vector<double>> panel_plays(const std::vector<Panel>& panels,
                                             const std::vector<std::vector<double>>& gaps);

}  // namespace holdfast::internal
