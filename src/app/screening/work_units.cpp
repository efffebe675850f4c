#include "app/screening/work_units.hpp"

#include <algorithm>

namespace holdfast {

namespace {

std::size_t blocks(std::size_t count, std::size_t size) { return (count + size - 1) / size; }

}  // namespace

WorkUnits::WorkUnits(std::size_t layout_count, std::size_t motion_count, const EngineTraits& traits)
    : layout_count_(layout_count),
      motion_count_(motion_count),
      layouts_per_unit_(std::max<std::size_t>(1, traits.layouts_per_unit)),
      // Several layouts a unit take all their accelerations along, or the worlds would not be consecutive.
      motions_per_unit_(layouts_per_unit_ > 1 ? std::max<std::size_t>(1, motion_count) : 1),
      layout_blocks_(blocks(layout_count, layouts_per_unit_)),
      motion_blocks_(blocks(motion_count, motions_per_unit_)) {}

WorkUnit WorkUnits::operator[](std::size_t i) const {
  WorkUnit unit;
  unit.layout_begin = i / motion_blocks_ * layouts_per_unit_;
  unit.layout_end = std::min(layout_count_, unit.layout_begin + layouts_per_unit_);
  unit.motion_begin = i % motion_blocks_ * motions_per_unit_;
  unit.motion_end = std::min(motion_count_, unit.motion_begin + motions_per_unit_);
  return unit;
}

std::size_t WorkUnits::first_world(std::size_t unit) const {
  const WorkUnit block = (*this)[unit];
  return block.layout_begin * motion_count_ + block.motion_begin;
}

std::size_t WorkUnits::sharing_layouts(std::size_t unit, std::size_t first) const {
  const std::size_t begin = unit / motion_blocks_ * motion_blocks_;
  return begin + motion_blocks_ - std::max(begin, first);
}

std::size_t WorkUnits::beginning_with(std::size_t world) const {
  const std::size_t layout_block = world / motion_count_ / layouts_per_unit_;
  const std::size_t motion_block = world % motion_count_ / motions_per_unit_;
  return layout_block * motion_blocks_ + motion_block;
}

}  // namespace holdfast
