#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/model/outcome.hpp"

namespace holdfast::internal {

/// Thresholds that separate a box that stayed from one that did not.
struct Thresholds {
  double drop = 0.05;  ///< m: fallen when the centre of mass is lower by more than this
  double move = 0.10;  ///< m: moved when displaced by more than this
  double tilt = 10.0;  ///< degrees: tilted when rotated by more than this
};

/// True when a displacement means that the box has fallen: the same rule for series, tables and counts.
bool is_fallen(const Float3& displacement, const Thresholds& thresholds);

/// True when a displacement means that the box has moved.
bool is_moved(const Float3& displacement, const Thresholds& thresholds);

/// True when the angle of a rotation means that the box is tilted.
/// @param tilt degrees
bool is_tilted(float tilt, const Thresholds& thresholds);

/// Length of a displacement, m, in float32 arithmetic, as a reader of the file would compute it.
float length(const Float3& displacement);

/// Verdict on box `i` of the table; without the time of its first move, which is in the series.
BoxVerdict judge_box(const EndTable& end, std::size_t i, const Thresholds& thresholds);

/// Verdict on a world.
/// @param end of its boxes
WorldVerdict judge_world(const WorldRow& world, const EndTable& end, const Thresholds& thresholds);

/// Time of the first sample at which a box is displaced by more than the move threshold, one entry per box, s;
/// NaN where this never happens.
/// @param time         one entry per sample, s
/// @param displacement one entry per sample and box, sample by sample, m
std::vector<float> first_move_times(std::span<const double> time, std::span<const Float3> displacement,
                                    std::size_t box_count, const Thresholds& thresholds);

}  // namespace holdfast::internal
