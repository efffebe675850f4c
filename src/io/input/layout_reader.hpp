#pragma once

#include <cstddef>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"
#include "io/input/text_file.hpp"

namespace holdfast::internal {

/// Columns of a line that holds a box.
inline constexpr std::size_t kLayoutColumns = 7;

/// Largest coordinate of a corner, cm: ten kilometres. An open side is no boundary; a larger coordinate is a mistake.
inline constexpr double kFarthestCorner = 1e6;

/// Longest header of a layout, bytes: every results file contains it.
inline constexpr std::size_t kMostHeaderBytes = 4096;

/// Reads a layout file.
///
/// The first line that is neither blank nor a comment is the header, which is not changed. Each further line is a box,
/// `x1 y1 z1 x2 y2 z2 material`: the corner with the smallest and the one with the largest coordinates in cm, and
/// an integer id from 0. `#` begins a comment anywhere in a line. `[Loads] Unit` and `Axes` may say other units and
/// axes.
///
/// With `UpAxis = z` the file's axes are the container's. With `UpAxis = y` the file has x along the length, y up and,
/// since its frame is also right-handed, z across the width from right to left. The frame is rotated by 90° about x and
/// moved by the width W, so that boxes inside the container remain inside and nothing is mirrored: (x, y, z) of the
/// file is (x, W − z, y) of the container. Accelerations are always in the container's axes.
///
/// All errors of the file are reported, up to the limit of ErrorList.
/// @param warnings receives one entry for a header that announces another number of boxes (see contradicted_count)
Result<Layout> read_layout_text(const TextFile& file, const Settings& settings, std::vector<Error>& warnings);

/// The same, and checks its geometry (see check_layout), if there is no other error.
/// @param warnings receives one entry for overlaps within the tolerance as well
Result<Layout> parse_layout(const TextFile& file, const Settings& settings, std::vector<Error>& warnings);

}  // namespace holdfast::internal
