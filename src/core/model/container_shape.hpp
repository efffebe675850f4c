#pragma once

#include <string>
#include <vector>

#include "core/base/vector.hpp"

namespace holdfast::internal {

/// A wall that is lower than the container: a drop side, over which boxes may tip.
struct DropSide {
  std::string side;     ///< front, rear, left or right
  double height = 0.0;  ///< above the floor, m
  friend bool operator==(const DropSide&, const DropSide&) = default;
};

/// The inside of a container: what a type of the catalogue says, and a load may say for itself.
struct ContainerShape {
  std::string type;                     ///< name in the catalogue of containers; empty: none of them
  Vec3 size = {5.87, 2.33, 2.20};       ///< inner length, width and height, m
  std::vector<std::string> open_sides;  ///< sides without a wall: front, rear, left, right, roof
  std::vector<DropSide> drop_sides;     ///< walls that are lower than the container
  /// Height of the floor above the ground, m; 0: a floor without end. Without effect where no side is open or low: no
  /// box gets out.
  double bed_height = 1.2;
  friend bool operator==(const ContainerShape&, const ContainerShape&) = default;
};

}  // namespace holdfast::internal
