#include "core/simulate.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace holdfast {

namespace {

/// Copies a world's range of the state columns.
void copy_state(const StateColumns& from, StateColumns& to, const World& world) {
  const auto offset = static_cast<std::ptrdiff_t>(world.box_begin);
  for_each_state_column(
      [&](const char*, const auto& source, auto& target) {
        std::copy_n(source.begin() + offset, world.box_count, target.begin() + offset);
      },
      from, to);
}

/// True when every box is slower than the threshold, in m/s and rad/s.
bool is_quiet(const StateView& state, double threshold) {
  const auto slow = [&](const Vec3& v) { return v.norm() < threshold; };
  return std::all_of(state.velocity.begin(), state.velocity.end(), slow) &&
         std::all_of(state.angular_velocity.begin(), state.angular_velocity.end(), slow);
}

/// Worlds that advance together, from settling to the end of the last one.
class Group {
 public:
  Group(Simulation& simulation, WorldBatch& batch, const Settings& settings, std::span<Recorder* const> recorders,
        const std::atomic<bool>& abort, std::vector<std::size_t> worlds)
      : simulation_(simulation),
        batch_(batch),
        settings_(settings),
        recorders_(recorders),
        abort_(abort),
        running_(std::move(worlds)),
        before_(batch.state),
        quiet_since_(batch.worlds.size(), 0.0),
        motion_(*batch.worlds[running_.front()].motion) {}

  /// False when aborted.
  bool run() {
    if (!settle()) return false;
    for (const Phase& phase : phases_of(motion_, latest_end(motion_, settings_))) {
      if (!run_phase(phase)) return false;
    }
    for (const std::size_t world : running_) finish(world, {.stop_reason = StopReason::timeout, .end_time = time_});
    return true;
  }

 private:
  const World& world_of(std::size_t world) const { return batch_.worlds[world]; }
  StateView state_of(const StateColumns& columns, std::size_t world) const { return view(columns, world_of(world)); }

  /// Gravity alone until t = 0, then the recorders' start.
  bool settle() {
    const StateColumns layout = batch_.state;
    std::vector<std::size_t> failed;
    // 0 − x: without settling time starts at 0, not at a negative zero.
    const Phase gravity_alone{0.0 - settings_.screening.settle_seconds, 0.0, Vec3::Zero()};
    time_ = gravity_alone.begin;
    while (time_ < gravity_alone.end && !running_.empty()) {
      if (abort_.load(std::memory_order_relaxed)) return false;
      advance(gravity_alone, gravity_alone.end);
      std::erase_if(running_, [&](std::size_t world) {
        if (is_finite(state_of(batch_.state, world))) return false;
        copy_state(layout, batch_.state, world_of(world));
        failed.push_back(world);
        return true;
      });
    }
    const auto start = [&](std::size_t world) {
      recorders_[world]->start(view(batch_.boxes, world_of(world)), state_of(layout, world),
                               state_of(batch_.state, world));
    };
    std::for_each(running_.begin(), running_.end(), start);
    for (const std::size_t world : failed) {
      start(world);
      finish(world, {.status = Status::non_finite, .stop_reason = StopReason::failed});
    }
    return true;
  }

  bool run_phase(const Phase& phase) {
    time_ = phase.begin;
    while (time_ < phase.end && !running_.empty()) {
      if (abort_.load(std::memory_order_relaxed)) return false;
      double watch = std::numeric_limits<double>::infinity();
      for (const std::size_t world : running_) watch = std::min(watch, recorders_[world]->watch());
      const double begin = time_;
      advance(phase, watch);
      std::erase_if(running_, [&](std::size_t world) { return record_step(world, begin, phase.acceleration); });
    }
    return true;
  }

  /// Tells the recorder of the step from `begin` to now. True when the world ends with it.
  bool record_step(std::size_t world, double begin, const Vec3& acceleration) {
    const StateView after = state_of(batch_.state, world);
    if (!is_finite(after)) {
      copy_state(before_, batch_.state, world_of(world));
      finish(world, {.status = Status::non_finite, .stop_reason = StopReason::failed, .end_time = begin});
      return true;
    }
    recorders_[world]->step({begin, time_, acceleration, state_of(before_, world), after});

    if (settings_.stopping_condition != StoppingCondition::sleeping) return false;
    if (!is_quiet(after, settings_.sleeping_threshold)) quiet_since_[world] = time_;
    const double quiet_from = std::max(quiet_since_[world], last_change_);
    if (time_ - quiet_from < kSleepingTime - kSameInstant) return false;
    finish(world, {.stop_reason = StopReason::sleeping, .end_time = time_});
    return true;
  }

  void advance(const Phase& phase, double watch) {
    for (const std::size_t world : running_) copy_state(batch_.state, before_, world_of(world));
    time_ = simulation_.advance(running_, phase, watch);
    for (const std::size_t world : running_) simulation_.read_back(world, batch_.state);
  }

  void finish(std::size_t world, Outcome outcome) {
    outcome.status = outcome.status | simulation_.status(world);
    outcome.counters = simulation_.counters(world);
    recorders_[world]->finish(outcome, state_of(batch_.state, world));
  }

  Simulation& simulation_;
  WorldBatch& batch_;
  const Settings& settings_;
  std::span<Recorder* const> recorders_;
  const std::atomic<bool>& abort_;
  std::vector<std::size_t> running_;
  StateColumns before_;
  std::vector<double> quiet_since_;  ///< end of the last step that was not quiet, a world, s
  const Motion& motion_;
  double last_change_ = last_change(motion_);
  double time_ = 0.0;
};

/// Worlds of the same motion together for an engine in lock step, else each for itself.
std::vector<std::vector<std::size_t>> groups_of(const WorldBatch& batch, bool lock_step) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t world = 0; world < batch.worlds.size(); ++world) {
    const auto same_motion = [&](const std::vector<std::size_t>& group) {
      return batch.worlds[group.front()].motion == batch.worlds[world].motion;
    };
    const auto group = lock_step ? std::find_if(groups.begin(), groups.end(), same_motion) : groups.end();
    if (group == groups.end()) {
      groups.push_back({world});
    } else {
      group->push_back(world);
    }
  }
  return groups;
}

}  // namespace

double latest_end(const Motion& motion, const Settings& settings) {
  if (settings.timeout) return *settings.timeout;
  const bool sleeping = settings.stopping_condition == StoppingCondition::sleeping;
  return motion.end_time() + (sleeping ? kSleepingPatience : 0.0);
}

bool simulate(const Engine& engine, WorldBatch& batch, const Settings& settings, std::span<Recorder* const> recorders,
              const std::atomic<bool>& abort) {
  const std::unique_ptr<Simulation> simulation = engine.build(batch);
  for (std::vector<std::size_t>& group : groups_of(batch, engine.traits().lock_step)) {
    if (!Group(*simulation, batch, settings, recorders, abort, std::move(group)).run()) return false;
  }
  return true;
}

}  // namespace holdfast
