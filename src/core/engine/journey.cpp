#include "core/engine/journey.hpp"

#include <algorithm>

#include "core/model/samples.hpp"

namespace holdfast::internal {

namespace {

/// Whether the acceleration is followed by a phase in which the load comes to rest.
bool runs_out(const Settings& settings) {
  return !settings.timeout && settings.stopping_condition == StoppingCondition::timeout &&
         settings.screening.run_out_seconds > 0.0;
}

}  // namespace

bool is_quiet(const StateView& state, double threshold) {
  const auto slow = [&](const Vec3& v) { return v.norm() < threshold; };
  return std::all_of(state.velocity.begin(), state.velocity.end(), slow) &&
         std::all_of(state.angular_velocity.begin(), state.angular_velocity.end(), slow);
}

double latest_end(const Acceleration& acceleration, const Settings& settings) {
  if (settings.timeout) return *settings.timeout;
  const bool sleeping = settings.stopping_condition == StoppingCondition::sleeping;
  return acceleration.end_time() + (sleeping ? kSleepingPatience : settings.screening.run_out_seconds);
}

double planned_end(const Acceleration& acceleration, const Settings& settings) {
  return settings.timeout ? *settings.timeout : acceleration.end_time();
}

std::vector<Phase> phases_for(const Engine& engine, const Acceleration& acceleration, const Settings& settings) {
  const double latest = latest_end(acceleration, settings);
  const bool is_cut = runs_out(settings);
  std::vector<Phase> phases = phases_of(acceleration, is_cut ? acceleration.end_time() : latest);
  const double longest_step = engine.traits().longest_step;
  if (longest_step > 0.0) phases = grouped(phases, longest_step);
  if (is_cut) phases.push_back({acceleration.end_time(), latest, Vec3::Zero()});
  return phases;
}

Journey::Journey(const Engine& engine, const Acceleration& acceleration, const Settings& settings)
    : phases_(phases_for(engine, acceleration, settings)),
      settles_first_(settings.screening.settle_seconds > 0.0),
      runs_out_(internal::runs_out(settings)),
      ends_by_sleeping_(settings.stopping_condition == StoppingCondition::sleeping),
      proves_rest_(engine.traits().proves_rest),
      last_change_(last_change(acceleration)) {
  if (!settles_first_) return;
  time_ = begin_ = quiet_since_ = -settings.screening.settle_seconds;
  phases_.insert(phases_.begin(), {time_, 0.0, Vec3::Zero()});
}

void Journey::cut(double time) {
  std::erase_if(phases_, [&](const Phase& one) { return one.end <= time + kSameInstant; });
  phase_ = 0;
  settles_first_ = runs_out_ = ends_by_sleeping_ = false;
  time_ = begin_ = time;
  if (!phases_.empty()) phases_.front().begin = time;
}

void Journey::set_acceleration(const Vec3& acceleration) {
  if (!phases_.empty()) phases_ = {{time_, phases_.back().end, acceleration}};
}

Journey::Event Journey::reach(double reached, bool rests, bool quiet) {
  begin_ = time_;
  time_ = reached;
  if (!quiet) quiet_since_ = reached;
  // Before t = 0 the acceleration has been constant, and so has it after its last change.
  const double quiet_from = settles() ? quiet_since_ : std::max(quiet_since_, last_change_);
  const bool has_slept = time_ - quiet_from >= kSleepingTime - kSameInstant;
  at_rest_ = rests || (!proves_rest_ && has_slept);
  if (settles()) {
    if (!at_rest_ && time_ < phase().end) return Event::none;
    time_ = quiet_since_ = 0.0;
    ++phase_;
    return Event::start;
  }
  if (runs_out() && at_rest_) {
    if (rests) time_ = begin_;
    stop_reason_ = StopReason::sleeping;
    return Event::end;
  }
  if (ends_by_sleeping_ && has_slept) {
    stop_reason_ = StopReason::sleeping;
    return Event::end;
  }
  if (time_ >= phase().end && ++phase_ == phases_.size()) return Event::end;
  return Event::none;
}

}  // namespace holdfast::internal
