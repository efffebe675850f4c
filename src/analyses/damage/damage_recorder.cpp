#include "analyses/damage/damage_recorder.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "analyses/settling.hpp"
#include "core/engine/interpolation.hpp"

namespace holdfast::internal {

DamageRecorder::DamageRecorder(const DamageBoundary& boundary, double window, double gravity, const StateView& start)
    : boundary_(boundary),
      window_(window),
      gravity_(gravity),
      peak_acceleration_(start.velocity.size(), 0.0),
      impacts_(start.velocity.size()) {
  recent_.push_back({0.0, {start.velocity.begin(), start.velocity.end()}});
}

void DamageRecorder::step(const Step& step) {
  settles_ = is_of_settling(step);
  const double duration = step.end - step.begin;
  container_velocity_ += duration * step.acceleration;
  // The oldest instant that is not needed any more lends its memory to the new one.
  Instant now{step.end, {}};
  while (recent_.size() > 1 && recent_[1].time <= step.end - window_) {
    now.velocity = std::move(recent_.front().velocity);
    recent_.pop_front();
  }
  now.velocity.resize(impacts_.size());
  for (std::size_t box = 0; box < impacts_.size(); ++box)
    now.velocity[box] = step.after.velocity[box] + container_velocity_;
  recent_.push_back(std::move(now));

  const std::vector<Vec3>& before = recent_[recent_.size() - 2].velocity;
  const std::vector<Vec3>& after = recent_.back().velocity;
  const double least_change = kImpactFactor * (gravity_ + step.acceleration.norm()) * duration;
  for (std::size_t box = 0; box < impacts_.size(); ++box) {
    const double acceleration = (after[box] - velocity_at_window(box)).norm() / window_;
    peak_acceleration_[box] = std::max(peak_acceleration_[box], acceleration);
    follow_impact(box, before[box], after[box], least_change);
  }
}

WorldDamage DamageRecorder::damage() const {
  if (settles_) {
    WorldDamage unknown;
    unknown.peak_acceleration.assign(impacts_.size(), std::numeric_limits<float>::quiet_NaN());
    unknown.velocity_change = unknown.peak_acceleration;
    unknown.beyond.assign(impacts_.size(), 0);
    return unknown;
  }
  WorldDamage damage{.boxes_beyond = 0};
  for (std::size_t box = 0; box < impacts_.size(); ++box) {
    const bool beyond =
        peak_acceleration_[box] > boundary_.acceleration && impacts_[box].change > boundary_.velocity_change;
    damage.peak_acceleration.push_back(static_cast<float>(peak_acceleration_[box]));
    damage.velocity_change.push_back(static_cast<float>(impacts_[box].change));
    damage.beyond.push_back(beyond ? 1 : 0);
    damage.boxes_beyond += beyond ? 1U : 0U;
  }
  return damage;
}

Vec3 DamageRecorder::velocity_at_window(std::size_t box) const {
  const double from = recent_.back().time - window_;
  const Instant& first = recent_[0];
  if (from <= first.time) return first.velocity[box];
  const Instant& second = recent_[1];
  return between(first.velocity[box], second.velocity[box], (from - first.time) / (second.time - first.time));
}

void DamageRecorder::follow_impact(std::size_t box, const Vec3& before, const Vec3& after, double least_change) {
  Impact& impact = impacts_[box];
  const bool struck = (after - before).norm() > least_change;
  if (struck && !impact.lasts) impact.before = before;
  impact.lasts = struck;
  if (struck) impact.change = std::max(impact.change, (after - impact.before).norm());
}

}  // namespace holdfast::internal
