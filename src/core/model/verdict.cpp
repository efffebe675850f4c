#include "core/model/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace holdfast::internal {

namespace {

/// Counts and numbers that are not known.
WorldVerdict not_simulated(Status status) {
  WorldVerdict world;
  visit_world_verdict<WorldVerdict>([&](const OutcomeField&, auto member) {
    using Number = std::decay_t<decltype(world.*member)>;
    if constexpr (std::is_floating_point_v<Number>) world.*member = std::numeric_limits<Number>::quiet_NaN();
    if constexpr (std::is_same_v<Number, std::uint32_t>) world.*member = kNotCounted;
  });
  world.verdict = status == Status::not_needed ? Verdict::not_needed : Verdict::failed;
  return world;
}

/// A layout that was not stable before any acceleration is unstable, even if the acceleration then moved nothing.
Verdict worst_of(const WorldRow& row, const WorldVerdict& world) {
  if (row.status != Status::ok) return Verdict::failed;
  // How the boxes would have ended is not known, and they may have come back: under no thresholds is there more to say.
  if (row.stop_reason == StopReason::decided) return Verdict::gave_way;
  if (world.fallen > 0) return Verdict::fell;
  if (world.moved + world.tilted > 0) return Verdict::moved;
  return world.unstable > 0 ? Verdict::unstable : Verdict::stayed;
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
  verdict.displacement = end.displacement[i];
  verdict.max_displacement = end.peak_displacement[i];
  verdict.tilt = end.tilt[i];
  verdict.kinetic_energy = end.kinetic_energy[i];
  verdict.peak_kinetic_energy = end.peak_kinetic_energy[i];
  verdict.first_move_time = std::numeric_limits<float>::quiet_NaN();
  verdict.drop = 0.0F - end.displacement[i].z;  // never −0
  verdict.fallen = is_fallen(end.displacement[i], thresholds);
  verdict.moved = is_moved(end.displacement[i], thresholds);
  verdict.tilted = is_tilted(end.tilt[i], thresholds);
  const Float3& settling = end.settling_displacement[i];
  verdict.unstable = is_fallen(settling, thresholds) || is_moved(settling, thresholds);
  return verdict;
}

WorldVerdict judge_world(const WorldRow& row, const EndTable& end, const Thresholds& thresholds) {
  if (row.stop_reason == StopReason::not_run) return not_simulated(row.status);
  WorldVerdict world;
  world.peak_kinetic_energy = row.peak_total_kinetic_energy;
  for (std::size_t i = 0; i < end.displacement.size(); ++i) {
    const BoxVerdict box = judge_box(end, i, thresholds);
    world.fallen += box.fallen ? 1 : 0;
    world.unstable += box.unstable ? 1 : 0;
    world.moved += box.moved ? 1 : 0;
    world.tilted += box.tilted ? 1 : 0;
    world.total_kinetic_energy += static_cast<double>(end.kinetic_energy[i]);
    world.max_displacement = std::max(world.max_displacement, length(end.displacement[i]));
    world.peak_displacement = std::max(world.peak_displacement, end.peak_displacement[i]);
  }
  world.verdict = worst_of(row, world);
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
