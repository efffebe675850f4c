#include "validate/laboratory.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "core/simulate.hpp"

namespace holdfast {

namespace {

double thread_cpu_seconds() {
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Passes what the drive loop sees on to an observer, and stops the loop when that has seen enough.
class ObservingRecorder final : public Recorder {
 public:
  ObservingRecorder(const Observer& observer, const std::atomic<bool>& abort) : observer_(observer), abort_(abort) {}

  void start(const BoxView& /*boxes*/, const StateView& /*layout*/, const StateView& settled) override {
    tell({0.0, 0.0, settled});
  }
  double watch() const override { return std::numeric_limits<double>::infinity(); }
  void step(const Step& step) override { tell({step.end, step.end - step.begin, step.after}); }
  void finish(const Outcome& outcome, const StateView& /*end*/) override { outcome_ = outcome; }

  const std::atomic<bool>& enough() const { return enough_; }
  const Outcome& outcome() const { return outcome_; }

 private:
  void tell(const Moment& moment) {
    outcome_.end_time = moment.time;
    if (!enough_ && (!observer_(moment) || abort_)) enough_ = true;
  }

  const Observer& observer_;
  const std::atomic<bool>& abort_;
  std::atomic<bool> enough_ = false;
  Outcome outcome_;
};

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
  Settings settings = scene.settings;
  setting_.choose(settings);
  WorldBatch batch = scene.batch();
  ObservingRecorder recorder(observer, abort_);
  Recorder* const recorders[] = {&recorder};
  const double begin = thread_cpu_seconds();
  const Result<std::unique_ptr<Engine>> engine = factory_(setting_.engine, settings);
  if (!engine) return {.status = Status::non_finite, .stop_reason = StopReason::failed};
  simulate(**engine, batch, settings, recorders, recorder.enough());

  cost_.cpu_seconds += thread_cpu_seconds() - begin;
  const auto movable = std::count_if(batch.boxes.mass.begin(), batch.boxes.mass.end(),
                                     [](double mass) { return std::isfinite(mass); });
  cost_.box_seconds += static_cast<double>(movable) * (recorder.outcome().end_time + settings.screening.settle_seconds);
  return recorder.outcome();
}

Snapshot final_state(Laboratory& laboratory, const Scene& scene) {
  Snapshot last;
  laboratory.run(scene, [&](const Moment& moment) {
    last = copy_of(moment);
    return true;
  });
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
    // Halving the logarithm finds thresholds of a few per cent as precisely as those near the bracket's end.
    const double middle = low > 0.0 && high > 4.0 * low ? std::sqrt(low * high) : 0.5 * (low + high);
    (exceeds(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace holdfast
