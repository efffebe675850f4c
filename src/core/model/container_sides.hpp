#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/model/contact_law.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// A side of the container.
struct ContainerSide {
  std::string_view name;
  int axis = 0;      ///< 0, 1, 2: x, y, z, perpendicular to the side
  bool far = false;  ///< at the inner size along the axis, not at 0
  SurfaceKind kind = SurfaceKind::wall;
  std::size_t index = 0;  ///< in `kContainerSides`
};

/// Least clearance that every box has to the roof, and to fixed boxes beside it and above it, when a world starts. It
/// prevents a box that fits exactly from being clamped: hard contacts with friction have solutions with any pressure,
/// although nothing presses.
/// @measured With 1 µm a column that is wedged under a roof is held beyond its limit at `screening`, and boxes that
/// enter between fixed ones go half as far; with 100 µm the clearance would be visible in results.
inline constexpr double kLeastPlay = 1e-5;  // m

/// The same to walls, where boxes touch both walls of an axis. A box gains speed before a wall holds it.
/// @measured With 10 µm a box that goes to and fro along a wall walks 8 % too far, and one that slides over upright
/// boxes before a wall 2 %. With none some loads of rows that fit exactly go a tenth to three quarters less far. Half
/// and twice: insensitive.
inline constexpr double kWallPlay = 1e-6;  // m

/// All sides: the one table of them. The floor is first, and is never open.
inline constexpr std::array<ContainerSide, 6> kContainerSides = {{{"floor", 2, false, SurfaceKind::floor, 0},
                                                                  {"front", 0, false, SurfaceKind::wall, 1},
                                                                  {"rear", 0, true, SurfaceKind::wall, 2},
                                                                  {"left", 1, false, SurfaceKind::wall, 3},
                                                                  {"right", 1, true, SurfaceKind::wall, 4},
                                                                  {"roof", 2, true, SurfaceKind::wall, 5}}};

/// What boxes push: the sides by their indices, then the ground beneath an open container, and the boxes that are fixed
/// to it, together.
inline constexpr std::size_t kGround = 6, kFixedBoxes = 7, kPushedCount = 8;
inline constexpr std::array<std::string_view, kPushedCount> kPushedNames = {"floor", "front", "rear",   "left",
                                                                            "right", "roof",  "ground", "fixed"};

/// Whether a side has that name and may be open.
bool can_be_open(std::string_view side);

/// Whether a side is open.
bool is_open(const ContainerSettings& container, const ContainerSide& side);

/// Takes the drop sides out of the open sides: where a type or a configuration has a side open, and it is then given a
/// height.
void close_drop_sides(ContainerShape& container);

/// Height of a wall above the floor, m: that of the container, less at a drop side, 0 at an open side.
double wall_height(const ContainerSettings& container, const ContainerSide& wall);

/// Whether what begins at a height above the floor, m, is above a drop side, and may stand out over it.
bool is_above_drop_side(const ContainerSettings& container, const ContainerSide& side, double bottom);

/// Whether any side is open, or a wall lower than the container, so that boxes can get out.
bool has_opening(const ContainerSettings& container);

/// The sides that are not open, floor first: floor, front, rear, left, right, roof.
std::vector<ContainerSide> closed_sides(const ContainerSettings& container);

}  // namespace holdfast::internal
