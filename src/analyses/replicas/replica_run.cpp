#include "analyses/replicas/replica_run.hpp"

#include <algorithm>
#include <list>
#include <memory>
#include <utility>
#include <vector>

#include "analyses/replicas/replica_draw.hpp"
#include "analyses/replicas/replica_inputs.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/engine/simulate.hpp"
#include "core/model/verdict.hpp"

namespace holdfast::internal {

namespace {

Acceleration scaled(const Acceleration& acceleration, double factor) {
  Acceleration made = acceleration;
  for (Segment& segment : made.segments) segment.acceleration *= factor;
  return made;
}

Verdict verdict_of(const WorldRecord& world, const Thresholds& thresholds) {
  return judge_world(world.row, world.end, by_run(thresholds)).verdict;
}

/// Whether the world holds, and no box was ever displaced, neither while the load settled nor later.
bool rests(const WorldRecord& world, const Thresholds& thresholds) {
  const auto rest = [](const std::vector<float>& peaks) {
    return std::all_of(peaks.begin(), peaks.end(), [](float peak) { return peak <= kRestDisplacement; });
  };
  return verdict_of(world, thresholds) == Verdict::stayed && rest(world.end.peak_displacement) &&
         rest(world.end.settling_peak_displacement);
}

/// Only whether a replica stays is asked.
RecordingPlan plan_of(const Settings& settings, const Acceleration& acceleration) {
  RecordingPlan plan = recording_plan(settings, false);
  plan.stop_when = StopWhen::moved;
  return plan_for(std::move(plan), acceleration);
}

class ReplicaRun {
 public:
  ReplicaRun(const Engine& engine, const Layout& layout, const Acceleration& acceleration, const WorldRecord& nominal,
             const Settings& settings, const std::atomic<bool>& abort)
      : engine_(engine),
        layout_(layout),
        acceleration_(acceleration),
        nominal_(nominal),
        settings_(settings),
        abort_(abort),
        plan_(plan_of(settings, acceleration)),
        planned_(static_cast<std::uint32_t>(settings.screening.replicas)),
        inputs_(layout, settings),
        box_failures_(layout.boxes.size()) {}

  std::optional<ReplicaOutcome> run() {
    const bool friction_alone = settings_.screening.acceleration_spread == 0.0 && !inputs_.shifts_boxes();
    if (friction_alone && rests(nominal_, plan_.thresholds)) {
      const std::optional<bool> rest = rests_with_least_friction();
      if (!rest) return std::nullopt;
      if (*rest) outcome_.count = planned_;
    }
    while (outcome_.count < planned_) {
      if (!run_block()) return std::nullopt;
      if (judge_share(interval(kEarlyScore)) != ReplicaVerdict::uncertain) break;
    }
    outcome_.share = static_cast<double>(outcome_.failed) / outcome_.count;
    const ShareInterval told = interval(kToldScore);
    outcome_.wilson_low = told.low;
    outcome_.wilson_high = told.high;
    outcome_.verdict = judge_share(told);
    for (const std::uint32_t failures : box_failures_)
      outcome_.box_share.push_back(static_cast<float>(failures) / static_cast<float>(outcome_.count));
    return std::move(outcome_);
  }

 private:
  ShareInterval interval(double score) const { return wilson_interval(outcome_.failed, outcome_.count, score); }

  /// Nothing when aborted.
  std::optional<bool> rests_with_least_friction() {
    ReplicaDraw least = inputs_.draws().front();
    for (const ReplicaDraw& draw : inputs_.draws()) lower_friction(least, draw);
    const std::optional<std::vector<WorldRecord>> worlds = simulate_draws({&least, 1}, outcome_.count);
    if (!worlds) return std::nullopt;
    return rests(worlds->front(), plan_.thresholds);
  }

  /// False when aborted.
  bool run_block() {
    const std::uint32_t size = std::min(kReplicaBlock, planned_ - outcome_.count);
    const std::optional<std::vector<WorldRecord>> worlds =
        simulate_draws(std::span(inputs_.draws()).subspan(outcome_.count, size), outcome_.count);
    if (!worlds) return false;
    for (const WorldRecord& world : *worlds) count(world);
    return true;
  }

  void count(const WorldRecord& world) {
    ++outcome_.count;
    if (verdict_of(world, plan_.thresholds) == Verdict::stayed) return;
    ++outcome_.failed;
    for (std::size_t i = 0; i < box_failures_.size(); ++i) {
      const BoxVerdict box = judge_box(world.end, i, by_run(plan_.thresholds));
      if (box.fallen || box.moved || box.tilted || box.unstable) ++box_failures_[i];
    }
  }

  /// Simulates the worlds of some draws together. Nothing when aborted.
  /// @param before number of the replica before them
  std::optional<std::vector<WorldRecord>> simulate_draws(std::span<const ReplicaDraw> draws, std::uint32_t before) {
    std::list<Acceleration> accelerations;  // worlds keep their addresses
    std::list<Layout> shifted;
    WorldBatch batch;
    std::vector<std::unique_ptr<SeriesRecorder>> owners;
    std::vector<Recorder*> recorders;
    for (const ReplicaDraw& draw : draws) {
      accelerations.push_back(scaled(acceleration_, draw.acceleration));
      if (inputs_.shifts_boxes()) shifted.push_back(inputs_.layout(++before));
      const Layout& layout = inputs_.shifts_boxes() ? shifted.back() : layout_;
      append_world(batch, layout, accelerations.back(), with_friction(settings_, draw));
      owners.push_back(std::make_unique<SeriesRecorder>(plan_));
      recorders.push_back(owners.back().get());
    }
    if (!simulate(engine_, batch, settings_, recorders, abort_)) return std::nullopt;
    outcome_.simulated += static_cast<std::uint32_t>(draws.size());
    std::vector<WorldRecord> records;
    for (const auto& owner : owners) records.push_back(owner->take());
    return records;
  }

  const Engine& engine_;
  const Layout& layout_;
  const Acceleration& acceleration_;
  const WorldRecord& nominal_;
  const Settings& settings_;
  const std::atomic<bool>& abort_;
  RecordingPlan plan_;
  std::uint32_t planned_;
  ReplicaInputs inputs_;
  std::vector<std::uint32_t> box_failures_;
  ReplicaOutcome outcome_;
};

}  // namespace

std::optional<ReplicaOutcome> run_replicas(const Engine& engine, const Layout& layout, const Acceleration& acceleration,
                                           const WorldRecord& nominal, const Settings& settings,
                                           const std::atomic<bool>& abort) {
  return ReplicaRun(engine, layout, acceleration, nominal, settings, abort).run();
}

}  // namespace holdfast::internal
