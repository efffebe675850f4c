#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/vector.hpp"
#include "core/model/container_shape.hpp"
#include "core/model/material_name.hpp"

namespace holdfast::internal {

/// One box of a load as it is loaded: axis-aligned, container frame (z up), metres. What is absent, its material and
/// the settings say.
struct Box {
  Vec3 corner_min;                           ///< corner with the smallest coordinates, m
  Vec3 corner_max;                           ///< corner with the largest coordinates, m
  MaterialName material;                     ///< what it is made of
  long line = 0;                             ///< line of the file that declares it, from 1
  std::string name = {};                     ///< shown to people; empty: its number
  std::optional<double> mass = {};           ///< kg
  std::optional<Vec3> centre_of_mass = {};   ///< offset from the middle of the box, axes of the container, m
  std::optional<double> mat = {};            ///< coefficient of friction on whatever it stands on: an anti-slip mat
  bool fixed = false;                        ///< part of the container
  std::optional<long> order = {};            ///< when it is loaded; absent: in the order of the boxes
  std::optional<double> bearing_limit = {};  ///< most that may rest on it, kg
};

/// A candidate loading of a container; it does not change after it is read.
/// A box's number is its position in `boxes`, counted from 1.
struct Layout {
  std::string name;        ///< file name without the folder, `#` and the name of the load where a file has several
  std::string sha256;      ///< of the file's bytes; of a load of a table or JSON that a run has, of its canonical JSON
  std::string header;      ///< first line of the file, not interpreted
  std::vector<Box> boxes;  ///< in the order of the file
  std::optional<ContainerShape> container = {};  ///< its own; absent: that of the run
};

}  // namespace holdfast::internal
