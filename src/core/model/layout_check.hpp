#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Most boxes of a layout. The largest container takes some thousand; the check of all pairs that meet along x, and the
/// memory of a world, stay bounded.
inline constexpr std::size_t kMostBoxes = 20'000;

/// Overlaps and protrusions up to this length are taken as rounding of the program that made the layout, m.
inline constexpr double kLayoutTolerance = 1e-4;

/// Which of the seven numbers of a box its material is, from 1: six coordinates are before it.
inline constexpr long kMaterialNumber = 7;

/// Geometric errors of a layout: corners that are not finite, extents that are negative or within rounding, boxes
/// outside the container (it has no boundary at open sides, and always one at the floor), boxes whose material puts the
/// centre of mass outside them, boxes that overlap. Empty when there are none.
///
/// The time is n log n plus the number of pairs whose extents along x overlap.
/// @param file     named in the messages
/// @param warnings receives one entry when there are overlaps or protrusions within the tolerance
std::vector<Error> check_layout(const Layout& layout, const Settings& settings, const std::string& file,
                                std::vector<Error>& warnings);

}  // namespace holdfast::internal
