#include "core/model/acceleration.hpp"

#include <algorithm>

namespace holdfast::internal {

double Acceleration::end_time() const {
  return segments.empty() ? 0.0 : segments.back().start + segments.back().duration;
}

Acceleration gravity_alone() { return {.name = "gravity alone", .sha256 = "", .segments = {{.duration = 2.0}}}; }

std::vector<Phase> phases_of(const Acceleration& acceleration, double end) {
  std::vector<Phase> phases;
  double time = 0.0;
  const auto add_until = [&](double until, const Vec3& value) {
    until = std::min(until, end);
    if (until - time <= kSameInstant) return;
    phases.push_back({time, until, value});
    time = until;
  };
  for (const Segment& segment : acceleration.segments) {
    add_until(segment.start, Vec3::Zero());
    add_until(segment.start + segment.duration, segment.acceleration);
  }
  add_until(end, Vec3::Zero());
  return phases;
}

double last_change(const Acceleration& acceleration) {
  // The phase after the end of the file counts: its acceleration is zero, that of the last segment may not be.
  const std::vector<Phase> phases = phases_of(acceleration, acceleration.end_time() + 1.0);
  std::size_t last = phases.size() - 1;
  while (last > 0 && phases[last - 1].acceleration == phases[last].acceleration) --last;
  return phases[last].begin;
}

}  // namespace holdfast::internal
