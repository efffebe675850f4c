#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/engine/analysis_method.hpp"
#include "core/engine/engine.hpp"
#include "core/engine/result_sink.hpp"
#include "core/engine/run_inputs.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/engine/simulate.hpp"
#include "core/model/settings.hpp"
#include "parallel/screening/timed_engine.hpp"
#include "parallel/screening/work_units.hpp"

namespace holdfast::internal {

/// Turns a unit of work into records: takes its layouts, simulates their worlds, keeps what they left. A layout
/// or acceleration that cannot be used, and a series that would be too large, become rows with a status. Shared by all
/// threads.
class UnitRunner {
 public:
  /// All must outlive this.
  /// @param analyses beside the verdicts
  UnitRunner(const Engine& engine, const Settings& settings, bool record_series, LayoutSource& layouts,
             std::span<const ReadAcceleration> accelerations, const std::atomic<bool>& abort, StageCosts& costs,
             AnalysisMethods analyses = {})
      : engine_(engine, costs),
        settings_(settings),
        plan_(recording_plan(settings, record_series, analyses)),
        layouts_(layouts),
        accelerations_(accelerations),
        abort_(abort),
        costs_(costs),
        analyses_(std::move(analyses)) {}

  /// The unit's records; nothing when aborted.
  /// @param sharing units of the run that take the same layouts, this one among them
  /// @param order   with FirstFailure: indices of all accelerations, in the order in which a layout is tried; the unit
  ///                has all of them
  std::optional<UnitRecord> run(const WorkUnit& unit, std::size_t sharing, std::span<const std::size_t> order = {});

 private:
  /// The layout; one that the engine cannot model, as one that cannot be used.
  std::shared_ptr<const ReadLayout> take(std::size_t layout, std::size_t takers) const;

  /// A world with the reason why it is not simulated, if there is one.
  WorldRecord refused(const ReadLayout& layout, std::size_t layout_index, std::size_t acceleration) const;

  /// Simulates those of a unit's worlds that have no such reason. Returns how many there were; less when aborted.
  std::size_t simulate_good(const WorkUnit& unit, const std::vector<std::shared_ptr<const ReadLayout>>& layouts,
                            std::vector<WorldRecord>& worlds) const;

  /// The same acceleration by acceleration, each for the layouts that have not failed before. The other worlds are not
  /// needed.
  std::size_t simulate_until_failure(const WorkUnit& unit,
                                     const std::vector<std::shared_ptr<const ReadLayout>>& layouts,
                                     std::span<const std::size_t> order, std::vector<WorldRecord>& worlds) const;

  /// Applies the analyses to a unit's layouts, and to its worlds that were simulated. False when aborted.
  bool analyse(const WorkUnit& unit, const std::vector<std::shared_ptr<const ReadLayout>>& layouts,
               UnitRecord& record) const;

  /// Every layout under every acceleration; nothing when aborted.
  std::vector<WorldRecord> simulate_batch(const std::vector<const Layout*>& layouts,
                                          const std::vector<const Acceleration*>& accelerations) const;

  /// A load under its next acceleration, as a batch of one world; nothing when aborted.
  std::vector<WorldRecord> simulate_next(LoadSimulation& load, const Acceleration& acceleration) const;

  RecordingPlan plan_of(const Acceleration& acceleration) const;

  TimedEngine engine_;
  const Settings& settings_;
  RecordingPlan plan_;
  LayoutSource& layouts_;
  std::span<const ReadAcceleration> accelerations_;
  const std::atomic<bool>& abort_;
  StageCosts& costs_;
  AnalysisMethods analyses_;
};

}  // namespace holdfast::internal
