#include "validate/laboratory/laboratory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/engine/simulate.hpp"
#include "parallel/schedulers/processor_time.hpp"

namespace holdfast::internal {

namespace {

/// Passes the steps of one world to an observer until the observer has finished.
class ObservingRecorder final : public Recorder {
 public:
  /// @param seen_enough called once, when the observer has finished
  ObservingRecorder(const Observer& observer, std::function<void()> seen_enough)
      : observer_(observer), seen_enough_(std::move(seen_enough)) {}

  void start(const BoxView& /*boxes*/, const StateView& /*layout*/, double /*time*/) override {}
  void accelerate(const StateView& settled) override { tell({0.0, 0.0, settled}); }
  void step(const Step& step) override { tell({step.end, step.end - step.begin, step.after}); }
  void finish(const Outcome& outcome, const StateView& /*end*/) override { outcome_ = outcome; }

  const Outcome& outcome() const { return outcome_; }

 private:
  void tell(const Moment& moment) {
    if (enough_) return;
    outcome_.end_time = moment.time;
    enough_ = !observer_(moment);
    if (enough_) seen_enough_();
  }

  const Observer& observer_;
  std::function<void()> seen_enough_;
  bool enough_ = false;
  Outcome outcome_;
};

/// The settings of a scene together with those of the solver.
Settings settings_of(const Scene& scene, const EngineSetting& setting) {
  Settings settings = scene.settings;
  setting.choose(settings);
  // The world begins and ends with the acceleration of the scene.
  settings.screening.settle_seconds = settings.screening.run_out_seconds = 0.0;
  for (std::optional<double>* rate : {&settings.steps_per_second, &settings.bullet.steps_per_second})
    if (*rate) **rate /= scene.step_factor;
  return settings;
}

Snapshot copy_of(const Moment& moment) {
  const StateView& state = moment.state;
  return {moment.time,
          {state.position.begin(), state.position.end()},
          {state.orientation.begin(), state.orientation.end()},
          {state.velocity.begin(), state.velocity.end()},
          {state.angular_velocity.begin(), state.angular_velocity.end()}};
}

}  // namespace

Laboratory::Laboratory(EngineFactory factory, const EngineSetting& setting, const std::atomic<bool>& abort)
    : factory_(std::move(factory)), setting_(setting), abort_(abort) {}

Outcome Laboratory::run(const Scene& scene, const Observer& observer) {
  return run({&scene, 1}, {&observer, 1}).front();
}

std::vector<Outcome> Laboratory::run(std::span<const Scene> scenes, std::span<const Observer> observers) {
  const Settings settings = settings_of(scenes.front(), setting_);
  WorldBatch batch;
  for (const Scene& scene : scenes) scene.append_to(batch);

  // The run ends when all observers have finished, or when it is aborted.
  std::atomic<bool> over = false;
  std::size_t watching = scenes.size();
  std::vector<Observer> watched;
  for (const Observer& observer : observers)
    watched.push_back([&](const Moment& moment) {
      if (abort_) over = true;
      return observer(moment);
    });
  std::vector<std::unique_ptr<ObservingRecorder>> owned;
  std::vector<Recorder*> recorders;
  for (const Observer& observer : watched) {
    owned.push_back(std::make_unique<ObservingRecorder>(observer, [&] {
      if (--watching == 0) over = true;
    }));
    recorders.push_back(owned.back().get());
  }

  const double begin = processor_seconds();
  const Result<std::unique_ptr<Engine>> engine = factory_(setting_.engine, settings);
  const bool has_mats = std::any_of(batch.boxes.surface.begin(), batch.boxes.surface.end(),
                                    [](const Surface& surface) { return surface.mat.has_value(); });
  if (!engine || (has_mats && !(*engine)->traits().has_mats))
    return std::vector<Outcome>(scenes.size(), {.status = Status::non_finite, .stop_reason = StopReason::failed});
  simulate(**engine, batch, settings, recorders, over);
  cost_.cpu_seconds += processor_seconds() - begin;

  std::vector<Outcome> outcomes;
  for (std::size_t world = 0; world < scenes.size(); ++world) {
    const BoxView boxes = view(batch.boxes, batch.worlds[world]);
    const auto movable =
        std::count_if(boxes.mass.begin(), boxes.mass.end(), [](double mass) { return std::isfinite(mass); });
    outcomes.push_back(owned[world]->outcome());
    cost_.cpu_seconds += outcomes.back().counters.device_seconds;
    cost_.box_seconds += static_cast<double>(movable) * outcomes.back().end_time;
  }
  return outcomes;
}

Snapshot final_state(Laboratory& laboratory, const Scene& scene) {
  Snapshot last;
  laboratory.run(scene, [&](const Moment& moment) {
    last = copy_of(moment);
    return true;
  });
  return last;
}

std::optional<Snapshot> final_state_if_any(Laboratory& laboratory, const Scene& scene) {
  std::optional<Snapshot> last;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    last = copy_of(moment);
    return true;
  });
  // An engine that cannot model the scene does not begin.
  if (last && outcome.stop_reason == StopReason::failed)
    last->position.assign(last->position.size(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  return last;
}

std::vector<Snapshot> final_states(Laboratory& laboratory, std::span<const Scene> scenes) {
  std::vector<Snapshot> last(scenes.size());
  std::vector<Observer> observers;
  for (Snapshot& snapshot : last)
    observers.push_back([&snapshot](const Moment& moment) {
      snapshot = copy_of(moment);
      return true;
    });
  laboratory.run(scenes, observers);
  return last;
}

double largest_displacement(Laboratory& laboratory, const Scene& scene) {
  double largest = 0.0;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    for (std::size_t i = 0; i < scene.boxes.size(); ++i)
      largest = std::max(largest, (moment.state.position[i] - scene.boxes[i].position).norm());
    return true;
  });
  return outcome.stop_reason == StopReason::failed ? std::numeric_limits<double>::infinity() : largest;
}

double turn_of(const Rotation& q) { return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w())); }

double time_to_reach(Laboratory& laboratory, const Scene& scene, double level,
                     const std::function<double(const StateView&)>& quantity) {
  double reached = std::numeric_limits<double>::infinity();
  double before = 0.0;
  laboratory.run(scene, [&](const Moment& moment) {
    const double now = quantity(moment.state);
    if (now >= level) {
      reached = now > before ? moment.time - moment.step * (now - level) / (now - before) : moment.time;
      return false;
    }
    before = now;
    return true;
  });
  return reached;
}

double smallest_amplitude(double low, double high, double precision, const std::function<bool(double)>& exceeds) {
  if (exceeds(low)) return low;
  if (!exceeds(high)) return high;
  while (high - low > precision * high) {
    // Bisection of the logarithm finds small thresholds with the same relative precision as large ones.
    const double middle = low > 0.0 && high > 4.0 * low ? std::sqrt(low * high) : 0.5 * (low + high);
    (exceeds(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace holdfast::internal
