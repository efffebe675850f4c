#pragma once

#include <cstddef>
#include <span>

#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// What was cut away.
struct Trimmed {
  std::size_t pairs = 0;
  double largest = 0.0;               ///< m
  std::size_t first = 0, second = 0;  ///< boxes of the largest
};

/// Overlaps up to this are trimmed in files, m, where the settings say nothing else: units and decimals of the programs
/// that write them round to as much.
inline constexpr double kFileOverlapTolerance = 1e-3;

/// Trims boxes that are in each other by more than rounding (`kLayoutTolerance`) and at most by the tolerance: half of
/// the overlap along the axis where it is least from each box, all of it from a box that meets a fixed one. Masses stay
/// what they were.
Trimmed trim_overlaps(Layout& layout, const Settings& settings, double tolerance);

/// Trims boxes at their tops where others sit in them.
/// @param nesting how far each box sits in the one beneath it, m
Trimmed nest_boxes(Layout& layout, std::span<const double> nesting, const Settings& settings);

}  // namespace holdfast::internal
