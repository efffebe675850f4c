#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "app/layout_shelf.hpp"
#include "app/timed_engine.hpp"
#include "app/work_units.hpp"
#include "core/engine.hpp"
#include "core/series_recorder.hpp"
#include "core/settings.hpp"
#include "io/results_writer.hpp"

namespace holdfast {

/// An acceleration of the run; one that could not be read has a message, and no segments.
struct RunMotion {
  Motion motion;
  std::string error;
};

/// Turns a unit of work into records: takes its layouts, simulates their worlds, keeps what they left. A layout
/// or acceleration that cannot be used becomes rows with a status. Shared by all threads.
class UnitRunner {
 public:
  UnitRunner(const Engine& engine, const Settings& settings, bool record_series,
             const std::vector<std::string>& layout_paths, const std::vector<std::string>& layout_hashes,
             const std::vector<RunMotion>& motions, const std::atomic<bool>& abort, StageCosts& costs)
      : engine_(engine, costs),
        settings_(settings),
        plan_(recording_plan(settings, record_series)),
        layouts_(layout_paths, layout_hashes, settings, costs),
        motions_(motions),
        abort_(abort),
        costs_(costs) {}

  /// The unit's records; nothing when aborted.
  /// @param sharing units of the run that take the same layouts, this one among them
  std::optional<UnitRecord> run(const WorkUnit& unit, std::size_t sharing);

 private:
  TimedEngine engine_;
  const Settings& settings_;
  RecordingPlan plan_;
  LayoutShelf layouts_;
  const std::vector<RunMotion>& motions_;
  const std::atomic<bool>& abort_;
  StageCosts& costs_;
};

}  // namespace holdfast
