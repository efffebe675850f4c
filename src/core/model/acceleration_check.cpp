#include "core/model/acceleration_check.hpp"

#include <array>
#include <cmath>
#include <string>

#include "core/base/number_text.hpp"

namespace holdfast::internal {

namespace {

constexpr std::array kNames{"ax", "ay", "az"};

}  // namespace

std::optional<SegmentFault> check_segment(const Segment& segment) {
  const auto fault = [](std::size_t column, std::string what, const char* accepted) {
    return SegmentFault{column, Error{.what = std::move(what), .accepted = accepted}};
  };
  if (!std::isfinite(segment.start) || !std::isfinite(segment.duration))
    return fault(std::isfinite(segment.start) ? 1 : 0, "a time is not a number", "a finite number of s");
  if (segment.start < 0.0) return fault(0, "the initial time is negative", "a time of at least 0 s");
  if (segment.start > kLatestSegment || segment.duration > kLatestSegment)
    return fault(segment.start > kLatestSegment ? 0 : 1, "the time is too large", "times of at most 1e6 s");
  if (segment.duration < kSameInstant) return fault(1, "the duration is too short", "a duration of at least 1e-9 s");
  for (std::size_t i = 0; i < 3; ++i) {
    const double component = segment.acceleration[static_cast<Eigen::Index>(i)];
    if (!std::isfinite(component))
      return fault(i + 2, std::string(kNames[i]) + " is not a number", "a finite number of m/s²");
    if (std::abs(component) > kLargestAcceleration)
      return fault(i + 2, std::string(kNames[i]) + " is too large", "accelerations from -10000 to 10000 m/s²");
  }
  return std::nullopt;
}

std::optional<Error> append_segment(std::vector<Segment>& segments, Segment segment) {
  if (!segments.empty()) {
    const Segment& before = segments.back();
    const double end = before.start + before.duration;
    if (std::abs(segment.start - end) < kSameInstant) segment.start = end;
    if (segment.start < end) {
      const bool unsorted = segment.start < before.start;
      const std::string which = before.line > 0 ? "that of line " + std::to_string(before.line)
                                                : "segment " + std::to_string(segments.size());
      return Error{.what = (unsorted ? "the segment is before " : "the segment overlaps ") + which,
                   .value = "starts at " + number_text(segment.start) + " s",
                   .accepted = unsorted ? "segments are in the order of their times"
                                        : "at least " + rounded_text(end, 12) + " s, where that one ends"};
    }
  }
  segments.push_back(segment);
  return std::nullopt;
}

}  // namespace holdfast::internal
