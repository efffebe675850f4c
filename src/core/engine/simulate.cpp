#include "core/engine/simulate.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace holdfast::internal {

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

/// Worlds that advance together, from settling to the end of the last one; each has its own clock.
class Group {
 public:
  Group(const Engine& engine, Simulation& simulation, WorldBatch& batch, const Settings& settings,
        std::span<Recorder* const> recorders, const std::atomic<bool>& abort, std::vector<std::size_t> worlds)
      : engine_(engine),
        simulation_(simulation),
        batch_(batch),
        settings_(settings),
        recorders_(recorders),
        abort_(abort),
        running_(std::move(worlds)),
        before_(batch.state),
        clocks_(batch.worlds.size()) {}

  /// False when aborted.
  bool run() {
    if (!settle()) return false;
    std::erase_if(running_, [&](std::size_t world) {
      const Acceleration& acceleration = *world_of(world).acceleration;
      clocks_[world] = {phases_for(engine_, acceleration, latest_end(acceleration, settings_)), 0, 0.0,
                        last_change(acceleration)};
      if (!clocks_[world].phases.empty()) return false;
      finish(world, {.stop_reason = StopReason::timeout});
      return true;
    });
    while (!running_.empty()) {
      if (abort_.load(std::memory_order_relaxed)) return false;
      for (const std::size_t world : running_) clocks_[world].begin = clocks_[world].time;
      advance([&](std::size_t world) { return recorders_[world]->output_time(); });
      std::erase_if(running_, [&](std::size_t world) { return record_step(world); });
    }
    return true;
  }

 private:
  /// The position of a world in its acceleration.
  struct Clock {
    std::vector<Phase> phases;
    std::size_t phase = 0;     ///< index of the phase that contains `time`
    double time = 0.0;         ///< s
    double last_change = 0.0;  ///< time from which the acceleration is constant, s
    double begin = 0.0;        ///< start of the last step, s
    double quiet_since = 0.0;  ///< end of the last step in which a box was not slow, s

    const Phase& now() const { return phases[phase]; }
  };

  const World& world_of(std::size_t world) const { return batch_.worlds[world]; }
  StateView state_of(const StateColumns& columns, std::size_t world) const { return view(columns, world_of(world)); }

  /// Simulates gravity alone until t = 0, then starts the recorders.
  bool settle() {
    const StateColumns layout = batch_.state;
    // 0 − x, not −x: without settling, time starts at 0 and not at −0.
    const Phase gravity_alone{0.0 - settings_.screening.settle_seconds, 0.0, Vec3::Zero()};
    for (const std::size_t world : running_) clocks_[world] = {{gravity_alone}, 0, gravity_alone.begin};
    std::vector<std::size_t> settling;
    if (gravity_alone.begin < gravity_alone.end) settling = running_;
    std::vector<std::pair<std::size_t, Status>> failed;
    std::swap(settling, running_);
    while (!running_.empty()) {
      if (abort_.load(std::memory_order_relaxed)) return false;
      advance([&](std::size_t) { return gravity_alone.end; });
      std::erase_if(running_, [&](std::size_t world) {
        const Status failure = failure_of(world);
        if (failure == Status::ok) return clocks_[world].time >= gravity_alone.end;
        copy_state(layout, batch_.state, world_of(world));
        failed.emplace_back(world, failure);
        return true;
      });
    }
    running_ = std::move(settling);
    std::erase_if(running_, [&](std::size_t world) {
      return std::any_of(failed.begin(), failed.end(), [&](const auto& entry) { return entry.first == world; });
    });
    const auto start = [&](std::size_t world) {
      recorders_[world]->start(view(batch_.boxes, world_of(world)), state_of(layout, world),
                               state_of(batch_.state, world));
    };
    std::for_each(running_.begin(), running_.end(), start);
    for (const auto& [world, failure] : failed) {
      start(world);
      finish(world, {.status = failure, .stop_reason = StopReason::failed});
    }
    return true;
  }

  /// The reason why the newest state of the world is invalid; ok if it is valid.
  Status failure_of(std::size_t world) const {
    if (!is_finite(state_of(batch_.state, world))) return Status::non_finite;
    return has(simulation_.status(world), Status::capacity) ? Status::capacity : Status::ok;
  }

  /// Passes the last step to the recorder. True when the world ends with this step.
  bool record_step(std::size_t world) {
    Clock& clock = clocks_[world];
    const Status failure = failure_of(world);
    if (failure != Status::ok) {
      copy_state(before_, batch_.state, world_of(world));
      finish(world, {.status = failure, .stop_reason = StopReason::failed, .end_time = clock.begin});
      return true;
    }
    const StateView after = state_of(batch_.state, world);
    Step step{clock.begin, clock.time, clock.now().acceleration, state_of(before_, world), after};
    SideImpulses impulses;
    if (settings_.screening.measures_walls()) {
      impulses = simulation_.side_impulses(world);
      step.side_impulses = &impulses;
    }
    recorders_[world]->step(step);

    if (settings_.stopping_condition == StoppingCondition::sleeping) {
      if (!is_quiet(after, settings_.sleeping_threshold)) clock.quiet_since = clock.time;
      const double quiet_from = std::max(clock.quiet_since, clock.last_change);
      if (clock.time - quiet_from >= kSleepingTime - kSameInstant) {
        finish(world, {.stop_reason = StopReason::sleeping, .end_time = clock.time});
        return true;
      }
    }
    if (clock.time >= clock.now().end && ++clock.phase == clock.phases.size()) {
      finish(world, {.stop_reason = StopReason::timeout, .end_time = clock.time});
      return true;
    }
    if (recorders_[world]->decided()) {
      finish(world, {.stop_reason = StopReason::decided, .end_time = clock.time});
      return true;
    }
    return false;
  }

  /// Advances all running worlds, each towards `output_time(world)`.
  template <class OutputTime>
  void advance(const OutputTime& output_time) {
    for (const std::size_t world : running_) copy_state(batch_.state, before_, world_of(world));
    requests_.clear();
    for (const std::size_t world : running_) requests_.push_back({world, clocks_[world].now(), output_time(world)});
    simulation_.advance(requests_);
    for (const AdvanceRequest& request : requests_) clocks_[request.world].time = request.reached;
    for (const std::size_t world : running_) simulation_.read_back(world, batch_.state);
  }

  void finish(std::size_t world, Outcome outcome) {
    outcome.status = outcome.status | simulation_.status(world);
    outcome.counters = simulation_.counters(world);
    recorders_[world]->finish(outcome, state_of(batch_.state, world));
  }

  const Engine& engine_;
  Simulation& simulation_;
  WorldBatch& batch_;
  const Settings& settings_;
  std::span<Recorder* const> recorders_;
  const std::atomic<bool>& abort_;
  std::vector<std::size_t> running_;
  StateColumns before_;
  std::vector<Clock> clocks_;  ///< one per world of the batch
  std::vector<AdvanceRequest> requests_;
};

/// Simulates all worlds together if the engine does so, otherwise one after the other.
std::vector<std::vector<std::size_t>> groups_of(const WorldBatch& batch, const EngineTraits& traits) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t world = 0; world < batch.worlds.size(); ++world) {
    if (groups.empty() || !traits.all_together) groups.emplace_back();
    groups.back().push_back(world);
  }
  return groups;
}

}  // namespace

double latest_end(const Acceleration& acceleration, const Settings& settings) {
  if (settings.timeout) return *settings.timeout;
  const bool sleeping = settings.stopping_condition == StoppingCondition::sleeping;
  return acceleration.end_time() + (sleeping ? kSleepingPatience : 0.0);
}

std::vector<Phase> phases_for(const Engine& engine, const Acceleration& acceleration, double end) {
  const std::vector<Phase> phases = phases_of(acceleration, end);
  const double longest_step = engine.traits().longest_step;
  return longest_step > 0.0 ? resampled(phases, longest_step) : phases;
}

double time_saved(Status status, StopReason stop_reason, double end_time, double latest_end) {
  if (status == Status::not_needed) return latest_end;
  return stop_reason == StopReason::decided ? latest_end - end_time : 0.0;
}

bool simulate(const Engine& engine, WorldBatch& batch, const Settings& settings, std::span<Recorder* const> recorders,
              const std::atomic<bool>& abort) {
  const std::unique_ptr<Simulation> simulation = engine.build(batch);
  for (std::vector<std::size_t>& group : groups_of(batch, engine.traits())) {
    if (!Group(engine, *simulation, batch, settings, recorders, abort, std::move(group)).run()) return false;
  }
  return true;
}

}  // namespace holdfast::internal
