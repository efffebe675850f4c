#pragma once

#include <optional>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/acceleration.hpp"

namespace holdfast::internal {

/// Latest start and longest duration of a segment, s: eleven days. More is a mistake, and would never end.
inline constexpr double kLatestSegment = 1e6;

/// Largest acceleration along an axis, m/s²: a thousand times gravity. More is a mistake.
inline constexpr double kLargestAcceleration = 1e4;

/// What is wrong with a number of a segment.
struct SegmentFault {
  std::size_t column = 0;  ///< 0 the start, 1 the duration, 2 to 4 the acceleration along x, y, z
  Error error;             ///< without file, line and value
};

/// The first number of a segment that is out of its range, if there is one.
std::optional<SegmentFault> check_segment(const Segment& segment);

/// Appends a segment, or says how it disagrees with the one before; a gap or an overlap that rounding explains is
/// closed. The error is without file, line and column.
std::optional<Error> append_segment(std::vector<Segment>& segments, Segment segment);

}  // namespace holdfast::internal
