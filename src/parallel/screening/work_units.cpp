#include "parallel/screening/work_units.hpp"

#include <algorithm>

namespace holdfast::internal {

namespace {

std::size_t blocks(std::size_t count, std::size_t size) { return (count + size - 1) / size; }

}  // namespace

WorkUnits::WorkUnits(std::size_t layout_count, std::size_t acceleration_count, const EngineTraits& traits,
                     bool whole_layouts)
    : layout_count_(layout_count),
      acceleration_count_(acceleration_count),
      layouts_per_unit_(std::max<std::size_t>(1, traits.layouts_per_unit)),
      // Several layouts per unit take all their accelerations along, or the worlds would not be consecutive.
      accelerations_per_unit_(whole_layouts || layouts_per_unit_ > 1 ? std::max<std::size_t>(1, acceleration_count)
                                                                     : 1),
      layout_blocks_(blocks(layout_count, layouts_per_unit_)),
      acceleration_blocks_(blocks(acceleration_count, accelerations_per_unit_)) {}

WorkUnit WorkUnits::operator[](std::size_t i) const {
  WorkUnit unit;
  unit.layout_begin = i / acceleration_blocks_ * layouts_per_unit_;
  unit.layout_end = std::min(layout_count_, unit.layout_begin + layouts_per_unit_);
  unit.acceleration_begin = i % acceleration_blocks_ * accelerations_per_unit_;
  unit.acceleration_end = std::min(acceleration_count_, unit.acceleration_begin + accelerations_per_unit_);
  return unit;
}

std::size_t WorkUnits::first_world(std::size_t unit) const {
  const WorkUnit block = (*this)[unit];
  return block.layout_begin * acceleration_count_ + block.acceleration_begin;
}

std::size_t WorkUnits::sharing_layouts(std::size_t unit, std::size_t first) const {
  const std::size_t begin = unit / acceleration_blocks_ * acceleration_blocks_;
  return begin + acceleration_blocks_ - std::max(begin, first);
}

std::size_t WorkUnits::beginning_with(std::size_t world) const {
  const std::size_t layout_block = world / acceleration_count_ / layouts_per_unit_;
  const std::size_t acceleration_block = world % acceleration_count_ / accelerations_per_unit_;
  return layout_block * acceleration_blocks_ + acceleration_block;
}

}  // namespace holdfast::internal
