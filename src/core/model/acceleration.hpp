#pragma once

#include <string>
#include <vector>

#include "core/base/vector.hpp"

namespace holdfast::internal {

/// A stretch of constant acceleration of the container, as the acceleration file declares it.
struct Segment {
  double start = 0.0;                ///< s
  double duration = 0.0;             ///< s, positive
  Vec3 acceleration = Vec3::Zero();  ///< of the container, m/s²
  long line = 0;                     ///< line of the acceleration file, from 1
};

/// What the container does: segments sorted by time, without overlap; zero acceleration in gaps and after
/// the last one. Constant once read.
struct Acceleration {
  std::string name;    ///< file name without the folder; labels the results
  std::string sha256;  ///< of the file's bytes, 64 hexadecimal digits
  std::vector<Segment> segments;

  /// End of the last segment, s; 0 without segments.
  double end_time() const;
};

/// A stretch of simulated time with constant acceleration of the container. Phases follow each other without
/// gap; steps never straddle their borders.
struct Phase {
  double begin = 0.0;                ///< s
  double end = 0.0;                  ///< s, after `begin`
  Vec3 acceleration = Vec3::Zero();  ///< of the container, m/s²
};

/// Times closer than this are the same instant, s: adds of decimal times leave differences of 1e-15 s, and
/// nothing a container does is faster than this.
inline constexpr double kSameInstant = 1e-9;

/// The acceleration cut into phases that cover [0, end) without gap; gaps and what follows the last segment have
/// zero acceleration. Neighbours of equal acceleration stay apart, as the file has them.
/// @param end end of the simulated time, s; phases are cut or a resting phase is added to reach it
std::vector<Phase> phases_of(const Acceleration& acceleration, double end);

/// Time of the last change of the acceleration, s: after it a(t) is constant for ever. 0 when it never changes.
double last_change(const Acceleration& acceleration);

}  // namespace holdfast::internal
