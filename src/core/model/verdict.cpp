#include "core/model/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
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

/// Where a box is, as an excursion.
Excursion excursion_to(const Float3& displacement, float tilt) {
  return {length(displacement), std::max(0.0F, -displacement.z), tilt};
}

Excursion journey_of(const EndTable& end, std::size_t i, const Judging& judging) {
  if (judging.at_end) return excursion_to(end.end_displacement[i], end.end_tilt[i]);
  return {end.peak_displacement[i], end.peak_drop[i], end.peak_tilt[i]};
}

Excursion settling_of(const EndTable& end, std::size_t i, const Judging& judging) {
  if (judging.at_end) return excursion_to(end.settling_displacement[i], 0.0F);
  return {end.settling_peak_displacement[i], end.settling_peak_drop[i], end.settling_peak_tilt[i]};
}

/// The largest share of a limit that the box has used up.
double share_of_limits(const Excursion& box, const Thresholds& thresholds) {
  const auto share = [](float peak, double limit) {
    return peak > 0.0F ? static_cast<double>(peak) / limit : 0.0;  // infinity where the limit is 0
  };
  return std::max(
      {share(box.displacement, thresholds.move), share(box.drop, thresholds.drop), share(box.tilt, thresholds.tilt)});
}

/// Share of a limit below which no box is worth a name: 1 mm of a displacement of 0.1 m.
constexpr double kNotableShare = 0.01;

/// The box that was beyond a limit first, in the order of the layout where several were in one step; where none was, or
/// times are not known, the one that used up most of a limit. Counted from 1; 0 where none has used
/// up `kNotableShare`.
std::uint32_t critical_box(const EndTable& end, const std::vector<BoxVerdict>& boxes, bool unstable,
                           const Judging& judging) {
  std::uint32_t first = 0;
  std::uint32_t farthest = 0;
  float earliest = std::numeric_limits<float>::infinity();
  double most = kNotableShare;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto id = static_cast<std::uint32_t>(i + 1);
    if (boxes[i].first_beyond < earliest) {  // false where it is NaN
      earliest = boxes[i].first_beyond;
      first = id;
    }
    const double share =
        share_of_limits(unstable ? settling_of(end, i, judging) : journey_of(end, i, judging), judging.thresholds);
    if (share > most) {
      most = share;
      farthest = id;
    }
  }
  return first > 0 ? first : farthest;
}

Verdict worst_of(const WorldRow& row, const WorldVerdict& world, const Judging& judging) {
  // As it was: which came first is not known, and worlds were accelerated that are unstable.
  if (judging.at_end && row.status != Status::ok) return Verdict::failed;
  if (world.unstable > 0 && !(judging.at_end && world.fallen + world.moved + world.tilted > 0))
    return Verdict::unstable;
  if (world.fallen > 0) return Verdict::fell;
  if (world.moved + world.tilted > 0) return Verdict::moved;
  return row.status == Status::ok ? Verdict::stayed : Verdict::failed;
}

/// Worse ones are larger.
int severity(Verdict verdict) {
  switch (verdict) {
    case Verdict::unstable:
      return 4;
    case Verdict::fell:
      return 3;
    case Verdict::moved:
      return 2;
    case Verdict::stayed:
      return 0;
    default:
      return 1;
  }
}

}  // namespace

void Excursion::extend(const Excursion& now) {
  displacement = std::max(displacement, now.displacement);
  drop = std::max(drop, now.drop);
  tilt = std::max(tilt, now.tilt);
}

bool is_fallen(const Float3& displacement, const Thresholds& thresholds) {
  return static_cast<double>(-displacement.z) > thresholds.drop;
}

bool has_fallen(const Excursion& box, const Thresholds& thresholds) {
  return static_cast<double>(box.drop) > thresholds.drop;
}

bool has_moved(const Excursion& box, const Thresholds& thresholds) {
  return static_cast<double>(box.displacement) > thresholds.move;
}

bool has_tilted(const Excursion& box, const Thresholds& thresholds) {
  return static_cast<double>(box.tilt) > thresholds.tilt;
}

bool is_beyond(const Excursion& box, const Thresholds& thresholds) {
  return has_fallen(box, thresholds) || has_moved(box, thresholds) || has_tilted(box, thresholds);
}

float tilt_of(const Rotation& turn) {
  // 2 atan2(|vector part|, |scalar part|)
  return static_cast<float>(2.0 * std::atan2(turn.vec().norm(), std::abs(turn.w())) * 180.0 / std::numbers::pi);
}

float length(const Float3& displacement) {
  return std::sqrt(displacement.x * displacement.x + displacement.y * displacement.y + displacement.z * displacement.z);
}

BoxVerdict judge_box(const EndTable& end, std::size_t i, const Judging& judging) {
  const Excursion journey = journey_of(end, i, judging);
  const bool same_limits = judging.thresholds == judging.run && !judging.at_end;
  return {.fallen = has_fallen(journey, judging.thresholds),
          .moved = has_moved(journey, judging.thresholds),
          .tilted = has_tilted(journey, judging.thresholds),
          .unstable = is_beyond(settling_of(end, i, judging), judging.thresholds),
          .fallen_at_end = is_fallen(end.end_displacement[i], judging.thresholds),
          .first_beyond = same_limits ? end.first_beyond[i] : std::numeric_limits<float>::quiet_NaN()};
}

WorldVerdict judge_world(const WorldRow& row, const EndTable& end, const Judging& judging) {
  if (row.stop_reason == StopReason::not_run) return not_simulated(row.status);
  WorldVerdict world;
  world.peak_kinetic_energy = row.peak_total_kinetic_energy;
  std::vector<BoxVerdict> boxes;
  Excursion peak;
  for (std::size_t i = 0; i < end.end_displacement.size(); ++i) {
    const BoxVerdict& box = boxes.emplace_back(judge_box(end, i, judging));
    world.fallen += box.fallen ? 1 : 0;
    world.unstable += box.unstable ? 1 : 0;
    world.moved += box.moved ? 1 : 0;
    world.tilted += box.tilted ? 1 : 0;
    world.fallen_at_end += box.fallen_at_end ? 1 : 0;
    world.end_kinetic_energy += static_cast<double>(end.end_kinetic_energy[i]);
    world.end_displacement = std::max(world.end_displacement, length(end.end_displacement[i]));
    peak.extend(journey_of(end, i, judging));
  }
  world.peak_displacement = peak.displacement;
  world.peak_drop = peak.drop;
  world.peak_tilt = peak.tilt;
  if (judging.at_end) {  // the one peak that such a file has
    for (const float displacement : end.peak_displacement)
      world.peak_displacement = std::max(world.peak_displacement, displacement);
    world.peak_drop = world.peak_tilt = std::numeric_limits<float>::quiet_NaN();
  }
  world.critical_box = critical_box(end, boxes, world.unstable > 0, judging);
  world.verdict = worst_of(row, world, judging);
  if (row.stop_reason == StopReason::decided && judging.thresholds != judging.run) {
    Judging of_run = judging;
    of_run.thresholds = judging.run;
    const Verdict known = judge_world(row, end, of_run).verdict;
    if (severity(known) > severity(world.verdict)) world.verdict = known;
  }
  return world;
}

}  // namespace holdfast::internal
