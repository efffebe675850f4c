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
  double mass = 0;  ///< kg; 0: the problem says nothing of it
};

/// A container loading problem: as much volume as possible of the boxes is to be loaded into one container.
struct Instance {
  Extents container = {};
  std::vector<BoxType> types;

  int box_count() const;
  bool has_masses() const { return !types.empty() && types.front().mass > 0; }
};

/// Reads a problem from a file in the format of Bischoff and Ratcliff (1995): the number of problems; for each its
/// number and its seed, the container, the number of types; for each type its number, three edges, each followed by 1
/// where it may be upright, and the number of boxes. Or in that of Ratcliff and Bischoff (1998), which begins with a
/// container: for each problem the container, the number of types and their volume; for each type the edges with their
/// 1, the number of boxes, the mass, and what each side bears, which is left alone. Throws std::runtime_error.
/// @param problem position in the file, from 1
Instance read_instance(const std::string& path, int problem);
