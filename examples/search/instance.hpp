#pragma once

#include <array>
#include <string>
#include <vector>

/// An edge length or a position along x, y and z, cm. Instances have whole numbers, so that all comparisons are exact.
using Extents = std::array<int, 3>;

/// Boxes that are alike.
struct BoxType {
  Extents edges = {};
  std::array<bool, 3> may_be_upright = {};  ///< which of the edges may be the vertical one
  int count = 0;
};

/// A container loading problem: as much volume as possible of the boxes is to be loaded into one container.
struct Instance {
  Extents container = {};
  std::vector<BoxType> types;

  int box_count() const;
};

/// Reads a problem from a file in the format of Bischoff and Ratcliff (1995): the number of problems; for each its
/// number and its seed, the container, the number of types; for each type its number, three edges, each followed by 1
/// where it may be upright, and the number of boxes. Throws std::runtime_error.
/// @param problem position in the file, from 1
Instance read_instance(const std::string& path, int problem);
