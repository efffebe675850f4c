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

/// Overlaps and protrusions up to this are rounding of the program that made the layout, m.
inline constexpr double kLayoutTolerance = 1e-4;

/// What is geometrically wrong with a layout: non-finite corners, extents that are negative or no more than rounding,
/// boxes outside the container (open sides do not bound it, the floor always does), boxes whose material puts the
/// centre of mass outside them, boxes that overlap. Empty when it is sound.
///
/// Costs n log n plus the number of pairs whose extents along x meet.
/// @param file     named in the messages
/// @param warnings gets one entry when there are overlaps or protrusions within the tolerance
std::vector<Error> check_layout(const Layout& layout, const Settings& settings, const std::string& file,
                                std::vector<Error>& warnings);

}  // namespace holdfast::internal
