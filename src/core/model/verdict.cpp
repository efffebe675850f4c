#include "core/model/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace holdfast::internal {

namespace {

WorldVerdict not_simulated(Status status) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr float kFloatNan = std::numeric_limits<float>::quiet_NaN();
  const Verdict verdict = status == Status::not_needed ? Verdict::not_needed : Verdict::failed;
  return {verdict, kNotCounted, kNotCounted, kNotCounted, kNotCounted, kNan, kNan, kFloatNan, kFloatNan};
}

/// A layout that was not stable before any acceleration is unstable, even if the acceleration then moved nothing.
Verdict worst_of(Status status, StopReason stop_reason, const WorldVerdict& world) {
  if (status != Status::ok) return Verdict::failed;
  // How the boxes would have ended is not known, and they may have come back: under no thresholds is there more to say.
  if (stop_reason == StopReason::decided) return Verdict::gave_way;
  if (world.fallen_boxes > 0) return Verdict::fell;
  if (world.moved_boxes + world.tilted_boxes > 0) return Verdict::moved;
  return world.unstable_boxes > 0 ? Verdict::unstable : Verdict::stayed;
}

}  // namespace

bool is_fallen(const Float3& displacement, const Thresholds& thresholds) {
  return static_cast<double>(-displacement.z) > thresholds.drop;
}

bool is_moved(const Float3& displacement, const Thresholds& thresholds) {
  return static_cast<double>(length(displacement)) > thresholds.move;
}

bool is_tilted(float tilt, const Thresholds& thresholds) { return static_cast<double>(tilt) > thresholds.tilt; }

float length(const Float3& displacement) {
  return std::sqrt(displacement.x * displacement.x + displacement.y * displacement.y + displacement.z * displacement.z);
}

BoxVerdict judge_box(const EndTable& end, std::size_t i, const Thresholds& thresholds) {
  BoxVerdict verdict;
  verdict.drop = 0.0F - end.displacement[i].z;  // never −0
  verdict.fallen = is_fallen(end.displacement[i], thresholds);
  verdict.moved = is_moved(end.displacement[i], thresholds);
  verdict.tilted = is_tilted(end.tilt[i], thresholds);
  const Float3& settling = end.settling_displacement[i];
  verdict.unstable = is_fallen(settling, thresholds) || is_moved(settling, thresholds);
  return verdict;
}

std::string to_string(Verdict verdict) {
  constexpr std::array<const char*, kVerdictCount> kNames = {"stayed", "moved",    "fell",      "unstable",
                                                             "failed", "gave_way", "not_needed"};
  return kNames.at(static_cast<std::size_t>(verdict));
}

WorldVerdict judge_world(Status status, StopReason stop_reason, double peak_kinetic_energy, const EndTable& end,
                         const Thresholds& thresholds) {
  if (stop_reason == StopReason::not_run) return not_simulated(status);
  WorldVerdict world;
  world.peak_kinetic_energy = peak_kinetic_energy;
  for (std::size_t i = 0; i < end.displacement.size(); ++i) {
    const BoxVerdict box = judge_box(end, i, thresholds);
    world.fallen_boxes += box.fallen ? 1 : 0;
    world.unstable_boxes += box.unstable ? 1 : 0;
    world.moved_boxes += box.moved ? 1 : 0;
    world.tilted_boxes += box.tilted ? 1 : 0;
    world.total_kinetic_energy += static_cast<double>(end.kinetic_energy[i]);
    world.max_displacement = std::max(world.max_displacement, length(end.displacement[i]));
    world.peak_displacement = std::max(world.peak_displacement, end.peak_displacement[i]);
  }
  world.verdict = worst_of(status, stop_reason, world);
  return world;
}

std::vector<float> first_move_times(std::span<const double> time, std::span<const Float3> displacement,
                                    std::size_t box_count, const Thresholds& thresholds) {
  std::vector<float> times(box_count, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t box = 0; box < box_count; ++box) {
    for (std::size_t sample = 0; sample < time.size(); ++sample) {
      if (static_cast<double>(length(displacement[sample * box_count + box])) <= thresholds.move) continue;
      times[box] = static_cast<float>(time[sample]);
      break;
    }
  }
  return times;
}

}  // namespace holdfast::internal
