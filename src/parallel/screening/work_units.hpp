#pragma once

#include <cstddef>

#include "core/engine/engine.hpp"

namespace holdfast::internal {

/// A block of the table of worlds, layouts × accelerations: what is handed out as one piece of work.
struct WorkUnit {
  std::size_t layout_begin = 0, layout_end = 0;
  std::size_t acceleration_begin = 0, acceleration_end = 0;
};

/// Cuts the table of worlds into units as the engine wants them. World order: layout by layout, acceleration
/// fastest; a unit's worlds are consecutive in it.
class WorkUnits {
 public:
  /// @param whole_layouts whether the worlds of a layout are one piece of work
  WorkUnits(std::size_t layout_count, std::size_t acceleration_count, const EngineTraits& traits,
            bool whole_layouts = false);

  std::size_t count() const { return layout_blocks_ * acceleration_blocks_; }
  WorkUnit operator[](std::size_t i) const;

  /// Index in the run of a unit's first world.
  std::size_t first_world(std::size_t unit) const;

  /// Units from `first` on that take the same layouts as `unit`, itself among them.
  std::size_t sharing_layouts(std::size_t unit, std::size_t first) const;

  /// Index of the unit that begins with world `world`, which must be the first of one.
  std::size_t beginning_with(std::size_t world) const;

 private:
  std::size_t layout_count_, acceleration_count_;
  std::size_t layouts_per_unit_, accelerations_per_unit_;
  std::size_t layout_blocks_, acceleration_blocks_;
};

}  // namespace holdfast::internal
