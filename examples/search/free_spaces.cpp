#include "free_spaces.hpp"

#include <algorithm>

double Cuboid::volume() const {
  double volume = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) volume *= high[axis] - low[axis];
  return volume;
}

bool Cuboid::contains(const Cuboid& other) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (other.low[axis] < low[axis] || other.high[axis] > high[axis]) return false;
  return true;
}

bool Cuboid::overlaps(const Cuboid& other) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (other.low[axis] >= high[axis] || other.high[axis] <= low[axis]) return false;
  return true;
}

FreeSpaces::FreeSpaces(const Extents& container, int smallest_edge)
    : smallest_edge_(smallest_edge), spaces_{{{0, 0, 0}, container}} {}

void FreeSpaces::occupy(const Cuboid& taken) {
  // What is left of a space is up to six cuboids, one on each side of what was taken.
  parts_.clear();
  const auto overlapped = [&](const Cuboid& space) { return space.overlaps(taken); };
  for (const Cuboid& space : spaces_) {
    if (!overlapped(space)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Cuboid below = space, above = space;
      below.high[axis] = taken.low[axis];
      above.low[axis] = taken.high[axis];
      for (const Cuboid& part : {below, above})
        if (part.high[axis] - part.low[axis] >= smallest_edge_) parts_.push_back(part);
    }
  }
  std::erase_if(spaces_, overlapped);

  // A part inside another space is no largest one. Of two equal parts the first is kept.
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto contains_it = [&](const Cuboid& other) { return other.contains(parts_[i]); };
    const bool inside = std::any_of(spaces_.begin(), spaces_.end(), contains_it) ||
                        std::any_of(parts_.begin() + static_cast<std::ptrdiff_t>(i) + 1, parts_.end(), contains_it);
    if (!inside) spaces_.push_back(parts_[i]);
  }
}
