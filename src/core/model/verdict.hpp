#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/engine/world_record.hpp"
#include "core/model/status.hpp"

namespace holdfast::internal {

/// Thresholds that separate a box that stayed from one that did not.
struct Thresholds {
  double drop = 0.05;  ///< m: fallen when the centre of mass is lower by more than this
  double move = 0.10;  ///< m: moved when displaced by more than this
  double tilt = 10.0;  ///< degrees: tilted when rotated by more than this
};

/// Verdict on one box. It depends only on values in the results file, so that it can be derived again from the file.
struct BoxVerdict {
  float drop = 0.0F;  ///< by how much the centre of mass is lower than in the reference pose, m; negative: higher
  bool fallen = false;
  bool moved = false;
  bool tilted = false;
  bool unstable = false;  ///< fell or moved while settling, before any acceleration
};

/// Verdict on a whole world: the worst that happened in it.
enum class Verdict : std::uint8_t {
  stayed = 0,      ///< no box fell, moved or tilted, nor was any unstable
  moved = 1,       ///< a box moved or tilted at the end, and none fell
  fell = 2,        ///< a box had fallen at the end
  unstable = 3,    ///< a box fell or moved while settling, before any acceleration, and no box did later
  failed = 4,      ///< the status is not ok: there is no verdict
  gave_way = 5,    ///< a box was beyond a threshold that StopWhen watches, and the world ended there
  not_needed = 6,  ///< the status is not_needed: nothing was asked
};
inline constexpr std::size_t kVerdictCount = 7;

/// Name of the verdict as above.
std::string to_string(Verdict verdict);

/// Result of one world. If it was not simulated, the counts are `kNotCounted` and the other numbers NaN.
struct WorldVerdict {
  Verdict verdict = Verdict::failed;
  std::uint32_t fallen_boxes = 0;
  std::uint32_t unstable_boxes = 0;
  std::uint32_t moved_boxes = 0;
  std::uint32_t tilted_boxes = 0;
  double total_kinetic_energy = 0.0;  ///< at the end, J
  double peak_kinetic_energy = 0.0;   ///< of all boxes together, over all steps, J
  float max_displacement = 0.0F;      ///< largest of all boxes at the end, m
  float peak_displacement = 0.0F;     ///< largest over all boxes and steps, m
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

/// Verdict on box `i` of the table.
BoxVerdict judge_box(const EndTable& end, std::size_t i, const Thresholds& thresholds);

/// Verdict on a world from the end of its simulation and of its boxes.
/// @param peak_kinetic_energy of all boxes together, over all steps, J; copied to the result
WorldVerdict judge_world(Status status, StopReason stop_reason, double peak_kinetic_energy, const EndTable& end,
                         const Thresholds& thresholds);

/// Time of the first sample at which a box is displaced by more than the move threshold, one entry per box, s;
/// NaN where this never happens.
/// @param time         one entry per sample, s
/// @param displacement one entry per sample and box, sample by sample, m
std::vector<float> first_move_times(std::span<const double> time, std::span<const Float3> displacement,
                                    std::size_t box_count, const Thresholds& thresholds);

}  // namespace holdfast::internal
