#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/layout_shelf.hpp"
#include "app/screening/timed_engine.hpp"
#include "app/screening/work_units.hpp"
#include "core/engine/engine.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/model/settings.hpp"
#include "io/results/results_writer.hpp"

namespace holdfast {

/// An acceleration of the run; one that could not be read has a message, and no segments.
struct RunAcceleration {
  Acceleration acceleration;
  std::string error;
};

/// Turns a unit of work into records: takes its layouts, simulates their worlds, keeps what they left. A layout
/// or acceleration that cannot be used, and a series that would be too large, become rows with a status. Shared by all
/// threads.
class UnitRunner {
 public:
  UnitRunner(const Engine& engine, const Settings& settings, bool record_series,
             const std::vector<std::string>& layout_paths, const std::vector<std::string>& layout_hashes,
             const std::vector<RunAcceleration>& accelerations, const std::atomic<bool>& abort, StageCosts& costs)
      : engine_(engine, costs),
        settings_(settings),
        plan_(recording_plan(settings, record_series)),
        layouts_(layout_paths, layout_hashes, settings, costs),
        accelerations_(accelerations),
        abort_(abort),
        costs_(costs) {}

  /// The unit's records; nothing when aborted.
  /// @param sharing units of the run that take the same layouts, this one among them
  std::optional<UnitRecord> run(const WorkUnit& unit, std::size_t sharing);

 private:
  /// A world with the reason why it is not simulated, if there is one.
  WorldRecord refused(const ReadLayout& layout, std::size_t layout_index, std::size_t acceleration) const;

  /// Simulates those of a unit's worlds that have no such reason. Returns how many there were; less when aborted.
  std::size_t simulate_good(const WorkUnit& unit, const std::vector<std::shared_ptr<const ReadLayout>>& layouts,
                            std::vector<WorldRecord>& worlds) const;

  /// Every layout under every acceleration; nothing when aborted.
  std::vector<WorldRecord> simulate_batch(const std::vector<Layout>& layouts,
                                          const std::vector<const Acceleration*>& accelerations) const;

  TimedEngine engine_;
  const Settings& settings_;
  RecordingPlan plan_;
  LayoutShelf layouts_;
  const std::vector<RunAcceleration>& accelerations_;
  const std::atomic<bool>& abort_;
  StageCosts& costs_;
};

}  // namespace holdfast
