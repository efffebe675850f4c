#include "core/engine/simulate.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/engine/journey.hpp"
#include "core/model/marginal_friction.hpp"

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

/// Worlds that advance together, from settling to the end of the last one; each has its own clock.
class Group {
 public:
  /// @param settled null, or of a group of one world: the end of its first step, where the simulation is marked because
  ///                the load rests in it; nothing where it does not, or has not been simulated before
  Group(const Engine& engine, Simulation& simulation, WorldBatch& batch, const Settings& settings,
        std::span<Recorder* const> recorders, const std::atomic<bool>& abort, std::vector<std::size_t> worlds,
        std::optional<double>* settled = nullptr)
      : simulation_(simulation),
        batch_(batch),
        settings_(settings),
        recorders_(recorders),
        abort_(abort),
        running_(std::move(worlds)),
        settled_(settled),
        before_(batch.state),
        clocks_(batch.worlds.size()) {
    for (const std::size_t world : running_) clocks_[world].emplace(engine, *world_of(world).acceleration, settings);
  }

  /// False when aborted.
  bool run() {
    std::erase_if(running_, [&](std::size_t world) {
      const Journey& journey = clocks_[world]->journey;
      recorders_[world]->start(view(batch_.boxes, world_of(world)), state_of(batch_.state, world), journey.time());
      if (!journey.settles()) return accelerate(world);
      return settled_ != nullptr && settled_->has_value() && go_on_from_mark(world);
    });
    while (!running_.empty()) {
      if (abort_.load(std::memory_order_relaxed)) return false;
      advance();
      std::erase_if(running_, [&](std::size_t world) { return record_step(world); });
    }
    return true;
  }

 private:
  struct Clock {
    Clock(const Engine& engine, const Acceleration& acceleration, const Settings& settings)
        : journey(engine, acceleration, settings) {}

    Journey journey;
    Counters before;                ///< of the engine, before the last step, while the world runs out
    double reached = 0.0;           ///< end of the last step, s
    bool accelerated = false;       ///< t = 0 is reached
    Caveat caveats = Caveat::none;  ///< found so far
  };

  const World& world_of(std::size_t world) const { return batch_.worlds[world]; }
  StateView state_of(const StateColumns& columns, std::size_t world) const { return view(columns, world_of(world)); }

  /// The reason why the newest state of the world is invalid; ok if it is valid.
  Status failure_of(std::size_t world) const {
    if (!is_finite(state_of(batch_.state, world))) return Status::non_finite;
    return has(simulation_.status(world), Status::capacity) ? Status::capacity : Status::ok;
  }

  /// Begins the acceleration. True when the world ends with that, since it has no time.
  bool accelerate(std::size_t world) {
    clocks_[world]->accelerated = true;
    recorders_[world]->accelerate(state_of(batch_.state, world));
    if (!clocks_[world]->journey.has_ended()) return false;
    finish(world, {.stop_reason = StopReason::timeout});
    return true;
  }

  /// Takes the first step as it was taken before. True when the world ends with it.
  bool go_on_from_mark(std::size_t world) {
    simulation_.rewind(world);
    simulation_.read_back(world, batch_.state);
    clocks_[world]->reached = **settled_;
    return record_step(world);
  }

  /// Passes the last step to the recorder. True when the world ends with this step.
  bool record_step(std::size_t world) {
    Clock& clock = *clocks_[world];
    Journey& journey = clock.journey;
    const double begin = journey.time();
    const Vec3 acceleration = journey.phase().acceleration;
    const Status failure = failure_of(world);
    if (failure != Status::ok) {
      copy_state(before_, batch_.state, world_of(world));
      finish(world, {.status = failure, .stop_reason = StopReason::failed, .end_time = begin});
      return true;
    }
    const StateView after = state_of(batch_.state, world);
    const bool quiet = is_quiet(after, settings_.sleeping_threshold);
    const Journey::Event event = journey.reach(clock.reached, simulation_.rests(world), quiet);
    if (event == Journey::Event::end && journey.time() == begin) {
      // The load was at rest before, as has been proved, and nothing was simulated.
      copy_state(before_, batch_.state, world_of(world));
      finish(world, {.stop_reason = journey.stop_reason(), .end_time = begin}, clock.before);
      return true;
    }
    Step step{begin, clock.reached, acceleration, state_of(before_, world), after, simulation_.status(world)};
    SideImpulses impulses;
    if (settings_.screening.measures_walls()) {
      impulses = simulation_.side_impulses(world);
      step.side_impulses = &impulses;
    }
    recorders_[world]->step(step);

    if (event == Journey::Event::end) {
      if (!quiet) clock.caveats = clock.caveats | Caveat::still_moving;
      finish(world, {.stop_reason = journey.stop_reason(), .end_time = clock.reached});
      return true;
    }
    if (recorders_[world]->decided() || (event == Journey::Event::start && recorders_[world]->is_unstable())) {
      finish(world, {.stop_reason = StopReason::decided, .end_time = clock.reached});
      return true;
    }
    if (event != Journey::Event::start) return false;
    if (!journey.is_at_rest()) clock.caveats = clock.caveats | Caveat::not_at_rest;
    const bool first_step = begin == -settings_.screening.settle_seconds;
    if (settled_ != nullptr && !settled_->has_value() && first_step && simulation_.rests(world)) {
      simulation_.mark(world);
      *settled_ = clock.reached;
    }
    return accelerate(world);
  }

  /// Takes every running world by one step.
  void advance() {
    requests_.clear();
    for (const std::size_t world : running_) {
      copy_state(batch_.state, before_, world_of(world));
      Clock& clock = *clocks_[world];
      if (clock.journey.runs_out()) clock.before = simulation_.counters(world);
      requests_.push_back({world, clock.journey.phase()});
    }
    simulation_.advance(requests_);
    for (const AdvanceRequest& request : requests_) {
      clocks_[request.world]->reached = request.reached;
      simulation_.read_back(request.world, batch_.state);
    }
  }

  void finish(std::size_t world, Outcome outcome) { finish(world, outcome, simulation_.counters(world)); }
  void finish(std::size_t world, Outcome outcome, const Counters& counters) {
    outcome.status = outcome.status | simulation_.status(world);
    outcome.caveats = clocks_[world]->caveats;
    if (clocks_[world]->accelerated &&
        has_marginal_friction(world_of(world), view(batch_.boxes, world_of(world)), settings_.gravity))
      outcome.caveats = outcome.caveats | Caveat::marginal;
    outcome.counters = counters;
    recorders_[world]->finish(outcome, state_of(batch_.state, world));
  }

  Simulation& simulation_;
  WorldBatch& batch_;
  const Settings& settings_;
  std::span<Recorder* const> recorders_;
  const std::atomic<bool>& abort_;
  std::vector<std::size_t> running_;
  std::optional<double>* settled_;
  StateColumns before_;
  std::vector<std::optional<Clock>> clocks_;  ///< one per world of the batch
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

double time_saved(Status status, StopReason stop_reason, double end_time, double planned_end) {
  if (status == Status::not_needed) return planned_end;
  // A world that is unstable has ended before the acceleration, whatever it is asked.
  return stop_reason == StopReason::decided && end_time > 0.0 ? std::max(0.0, planned_end - end_time) : 0.0;
}

bool simulate(const Engine& engine, WorldBatch& batch, const Settings& settings, std::span<Recorder* const> recorders,
              const std::atomic<bool>& abort) {
  const std::unique_ptr<Simulation> simulation = engine.build(batch);
  for (std::vector<std::size_t>& group : groups_of(batch, engine.traits())) {
    if (!Group(engine, *simulation, batch, settings, recorders, abort, std::move(group)).run()) return false;
  }
  return true;
}

bool LoadSimulation::run(const Acceleration& acceleration, Recorder& recorder, const std::atomic<bool>& abort) {
  if (!simulation_) {
    batch_ = {};
    append_world(batch_, layout_, acceleration, settings_);
    layout_pose_ = batch_.state;
    simulation_ = engine_.build(batch_);
  }
  batch_.worlds.front().acceleration = &acceleration;
  batch_.state = layout_pose_;
  Recorder* const recorders[] = {&recorder};
  std::optional<double>* const settled = engine_.traits().rewinds ? &settled_ : nullptr;
  const bool ended = Group(engine_, *simulation_, batch_, settings_, recorders, abort, {0}, settled).run();
  if (!settled_) simulation_.reset();
  return ended;
}

}  // namespace holdfast::internal
