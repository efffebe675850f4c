#pragma once

#include <string>
#include <vector>

#include "core/base/vector.hpp"

namespace holdfast::internal {

/// One box of a layout as it was loaded: axis-aligned, container frame (z up), metres.
struct Box {
  Vec3 corner_min;   ///< corner with the smallest coordinates, m
  Vec3 corner_max;   ///< corner with the largest coordinates, m
  int material = 0;  ///< material id of the layout file
  long line = 0;     ///< line of the layout file that declares it, from 1
};

/// A candidate loading of the container; it does not change after it is read.
/// A box's id is its position in `boxes`, counted from 1.
struct Layout {
  std::string name;        ///< file name without the folder; labels the results
  std::string sha256;      ///< of the file's bytes, 64 hexadecimal digits
  std::string header;      ///< first line of the file, not interpreted
  std::vector<Box> boxes;  ///< in the order of the file
};

}  // namespace holdfast::internal
