#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/world_record.hpp"

namespace holdfast {

/// Limits that separate a box that stayed from one that did not.
struct Thresholds {
  double drop = 0.05;  ///< m: fallen when the centre of mass is lower by more
  double move = 0.10;  ///< m: moved when displaced by more
  double tilt = 10.0;  ///< degrees: tilted when rotated by more
};

/// What became of one box. Judged from the values of the results file, so that anyone can judge them again.
struct BoxVerdict {
  float drop = 0.0F;  ///< by how much the centre of mass is lower than in the reference pose, m; negative: higher
  bool fallen = false;
  bool moved = false;
  bool tilted = false;
  bool unstable = false;  ///< fell or moved while settling, before any acceleration
};

/// What became of one world.
struct WorldVerdict {
  std::uint32_t fallen_boxes = 0;
  std::uint32_t unstable_boxes = 0;
  std::uint32_t moved_boxes = 0;
  std::uint32_t tilted_boxes = 0;
  double total_kinetic_energy = 0.0;  ///< at the end, J
  float max_displacement = 0.0F;      ///< largest of all boxes at the end, m
  float peak_displacement = 0.0F;     ///< largest of all boxes and steps, m
};

/// True when a displacement means that the box has fallen: the one rule for series, tables and counts.
bool is_fallen(const Float3& displacement, const Thresholds& thresholds);

/// Length of a displacement, m, in float32 arithmetic as a reader of the file would form it.
float length(const Float3& displacement);

/// Verdict on box `i` of the table.
BoxVerdict judge_box(const EndTable& end, std::size_t i, const Thresholds& thresholds);

/// Verdict on a world from the ends of its boxes.
WorldVerdict judge_world(const EndTable& end, const Thresholds& thresholds);

/// Time of the first sample at which a box is displaced by more than the move threshold, an entry a box, s;
/// not-a-number where that never happens.
/// @param time         an entry a sample, s
/// @param displacement rows, sample after sample, m
std::vector<float> first_move_times(std::span<const double> time, std::span<const Float3> displacement,
                                    std::size_t box_count, const Thresholds& thresholds);

}  // namespace holdfast
