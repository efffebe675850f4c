#pragma once

#include <tuple>
#include <vector>

#include "instance.hpp"

/// A cuboid along the axes of the container.
struct Cuboid {
  Extents low = {}, high = {};

  double volume() const;  ///< cm³
  bool contains(const Cuboid& other) const;
  bool overlaps(const Cuboid& other) const;
  bool operator<(const Cuboid& other) const { return std::tie(low, high) < std::tie(other.low, other.high); }
};

/// The largest cuboids of a container that contain nothing. They may overlap each other (maximal spaces: Lai and Chan,
/// Computers & Industrial Engineering 32, 1997).
class FreeSpaces {
 public:
  /// @param smallest_edge a space that is narrower is of no use and is dropped, cm
  FreeSpaces(const Extents& container, int smallest_edge);

  /// Takes a cuboid away from all spaces.
  void occupy(const Cuboid& taken);

  const std::vector<Cuboid>& all() const { return spaces_; }

 private:
  int smallest_edge_;
  std::vector<Cuboid> spaces_, parts_;
};
