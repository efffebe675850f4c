#pragma once

#include <cstddef>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/acceleration.hpp"
#include "io/input/text_file.hpp"

namespace holdfast::internal {

/// Columns of a line, which holds a segment.
inline constexpr std::size_t kAccelerationColumns = 5;

/// Reads an acceleration file: one line per segment, `initial-time duration ax ay az` in s and m/s², in the order of
/// time and without overlap; in gaps the acceleration is zero. `#` begins a comment anywhere in a line. A segment that
/// starts within kSameInstant of the end of the previous one starts exactly there. A first line `unit g` says that
/// accelerations are in g, 9.81 m/s².
///
/// All errors of the file are reported, up to the limit of ErrorList.
/// @param warnings receives one entry when no unit is stated and the values are as small as those of norms in g
Result<Acceleration> parse_acceleration(const TextFile& file, std::vector<Error>& warnings);

}  // namespace holdfast::internal
