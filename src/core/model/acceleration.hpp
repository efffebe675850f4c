#pragma once

#include <string>
#include <vector>

#include "core/base/vector.hpp"

namespace holdfast::internal {

/// An interval of constant acceleration of the container, as the acceleration file declares it.
struct Segment {
  double start = 0.0;                ///< s
  double duration = 0.0;             ///< s, positive
  Vec3 acceleration = Vec3::Zero();  ///< of the container, m/s²
  long line = 0;                     ///< line of the acceleration file, from 1
};

/// The acceleration of the container over time: segments sorted by time, without overlap; zero in gaps and after the
/// last segment. It does not change after it is read.
struct Acceleration {
  std::string name;    ///< file name without the folder; labels the results
  std::string sha256;  ///< of the file's bytes, 64 hexadecimal digits
  std::vector<Segment> segments;
  std::string purpose = {};  ///< what a norm states it for alone, "sliding" or "tipping"; else empty

  /// End of the last segment, s; 0 without segments.
  double end_time() const;
};

/// No acceleration for two seconds: tells whether a layout stands at all.
Acceleration gravity_alone();

/// An interval of simulated time with constant acceleration of the container. Phases follow each other without gaps;
/// no step crosses the boundary between two phases.
struct Phase {
  double begin = 0.0;                ///< s
  double end = 0.0;                  ///< s, after `begin`
  Vec3 acceleration = Vec3::Zero();  ///< of the container, m/s²
  /// Of a group of samples, see `grouped`: what the acceleration is the mean of, without gaps; else empty.
  std::vector<Phase> samples = {};
};

/// Times closer than this are the same instant, s: sums of decimal times have errors of about 1e-15 s, and no motion of
/// a container is as fast as this.
inline constexpr double kSameInstant = 1e-9;

/// The acceleration divided into phases that cover [0, end) without gap; gaps and the time after the last segment have
/// zero acceleration. Neighbouring segments of equal acceleration remain separate phases, as in the file.
/// @param end end of the simulated time, s; phases are shortened or a phase of zero acceleration is added to reach it
std::vector<Phase> phases_of(const Acceleration& acceleration, double end);

/// Time of the last change of the acceleration, s; after it a(t) is constant. 0 when it never changes.
double last_change(const Acceleration& acceleration);

}  // namespace holdfast::internal
