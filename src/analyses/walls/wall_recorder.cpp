#include "analyses/walls/wall_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analyses/settling.hpp"
#include "analyses/walls/wall_limits.hpp"
#include "core/model/push_direction.hpp"

namespace holdfast::internal {

namespace {

/// A force is a new peak where it is larger by more than this share: a force that merely lasts has the time at which it
/// began, whatever its last digits.
constexpr double kNewPeak = 1e-9;

}  // namespace

WallRecorder::WallRecorder(std::optional<WallNorm> norm, const BoxView& boxes) {
  double mass = 0.0;
  for (const double of_box : boxes.mass) mass += std::isfinite(of_box) ? of_box : 0.0;
  forces_.limit = wall_limits(norm, mass * kStandardGravity);
  forces_.peak_force.fill(0.0);
  forces_.peak_time.fill(0.0);
  forces_.lasting_force.fill(0.0);
  forces_.impulse.fill(Vec3::Zero());
}

void WallRecorder::step(const Step& step) {
  settles_ = is_of_settling(step);
  const SideImpulses& sides = *step.side_impulses;
  Recent now{step.begin, step.end, {}};
  for (std::size_t side = 0; side < kPushedCount; ++side)
    now.force[side] = pressing(side, sides[side].impulse) / (step.end - step.begin);
  std::erase_if(recent_, [&](const Recent& earlier) { return earlier.end <= step.end - kLastingSeconds; });
  recent_.push_back(now);
  for (std::size_t side = 0; side < kPushedCount; ++side) {
    // Adding 0 turns −0 into 0, which is easier to read.
    force_now_[side] = static_cast<float>(now.force[side]) + 0.0F;
    forces_.impulse[side] += sides[side].impulse;
    forces_.lasting_force[side] = std::max(forces_.lasting_force[side], lasting_force(side));
    if (now.force[side] <= (1.0 + kNewPeak) * forces_.peak_force[side]) continue;
    forces_.peak_force[side] = now.force[side];
    forces_.peak_time[side] = step.begin;
    forces_.peak_point[side] = sides[side].weighted_point / sides[side].pressed;
  }
}

void WallRecorder::finish(Findings& found) {
  if (settles_) {
    WallForces unknown;
    unknown.force = std::move(forces_.force);
    forces_ = std::move(unknown);
  }
  found.put(std::move(forces_));
}

double WallRecorder::lasting_force(std::size_t side) const {
  const double from = recent_.back().end - kLastingSeconds;
  double impulse = 0.0;
  for (const Recent& step : recent_) impulse += (step.end - std::max(step.begin, from)) * step.force[side];
  return impulse / kLastingSeconds;
}

}  // namespace holdfast::internal
