#pragma once

#include <cstddef>
#include <vector>

#include "core/base/vector.hpp"
#include "core/model/outcome.hpp"

namespace holdfast::internal {

/// The limits of a box: thresholds that separate a box that stayed from one that did not.
struct Thresholds {
  double drop = 0.05;  ///< m: fallen when the centre of mass is lower by more than this
  double move = 0.10;  ///< m: moved when displaced by more than this
  double tilt = 10.0;  ///< degrees: tilted when rotated by more than this

  bool operator==(const Thresholds&) const = default;
};

/// How worlds are judged.
struct Judging {
  Thresholds thresholds;
  Thresholds run;       ///< of the run: they may have ended the world early, and the order of boxes is by them
  bool at_end = false;  ///< by where boxes are at the end: files of versions 1 and 2 have no peaks
};

/// By the thresholds of the run itself.
inline Judging by_run(const Thresholds& run) { return {.thresholds = run, .run = run}; }

/// How far a box has ever been from its reference pose: what the limits are compared with.
struct Excursion {
  float displacement = 0.0F;  ///< largest length, m
  float drop = 0.0F;          ///< by how much the centre of mass was lower at most, m
  float tilt = 0.0F;          ///< largest angle of rotation, degrees

  /// Takes in where the box is now.
  void extend(const Excursion& now);
};

/// True when a displacement means that the box has fallen: the same rule for series, tables and counts.
bool is_fallen(const Float3& displacement, const Thresholds& thresholds);

/// True when the box was beyond that limit.
bool has_fallen(const Excursion& box, const Thresholds& thresholds);
bool has_moved(const Excursion& box, const Thresholds& thresholds);
bool has_tilted(const Excursion& box, const Thresholds& thresholds);
bool is_beyond(const Excursion& box, const Thresholds& thresholds);

/// Angle of a rotation, degrees, from 0 to 180.
float tilt_of(const Rotation& turn);

/// Length of a displacement, m, in float32 arithmetic, as a reader of the file would compute it.
float length(const Float3& displacement);

/// Judgement on box `i` of the table.
BoxVerdict judge_box(const EndTable& end, std::size_t i, const Judging& judging);

/// Judgement on a world. A limit that is exceeded before the first bit of the status counts, since peaks end there;
/// otherwise a status that is not 0 is `failed`. A world that ended by a limit of its run has at least the verdict of
/// its run, also by looser limits: what it would have done later is not known.
/// @param end of its boxes
WorldVerdict judge_world(const WorldRow& world, const EndTable& end, const Judging& judging);

}  // namespace holdfast::internal
