#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/progress.hpp"
#include "app/screening.hpp"
#include "app/screening/stage_costs.hpp"
#include "app/screening/unit_runner.hpp"
#include "app/stop_signal.hpp"
#include "core/model/verdict.hpp"
#include "io/results/results_resume.hpp"
#include "io/results/results_writer.hpp"

namespace holdfast {

/// A world by its inputs.
struct WorldPlace {
  std::size_t layout = 0;
  std::size_t acceleration = 0;
};

/// The worlds of a run from the first unit to the last: what its threads share.
class WorldRun {
 public:
  WorldRun(const ScreeningJob& job, const Engine& engine, const std::vector<std::string>& layout_hashes,
           const std::vector<RunAcceleration>& accelerations, ResultsWriter& writer, const Progress& finished,
           StageCosts& costs);

  /// False when it was stopped or writing failed: then the results are not all there.
  bool go();

  bool write_failed() const { return error_.has_value(); }
  std::uint64_t done() const { return counts_.done; }
  std::uint64_t total() const { return counts_.total; }

 private:
  /// Says what became of a unit's worlds, in their order.
  void announce(const UnitRecord& record);

  bool write(PackedUnit&& unit);

  /// Keeps the first error, from whichever thread.
  void keep(std::optional<Error> error);

  /// Runs a stage of the unit that begins with a world; nothing, and an error kept, when memory runs out.
  /// @param done  what the stage does to the world, in words
  template <class Work>
  auto with_memory(WorldPlace world, const char* done, Work&& work) -> decltype(work());

  /// Not under the lock: a reader that pauses must not keep the open part from being closed in time.
  void print_lines();

  /// Four times a second: the open part may be due though no world has finished; news for the user.
  void tick(ProgressLine& line);

  const ScreeningJob& job_;
  const Engine& engine_;
  const std::vector<std::string>& layout_hashes_;
  const std::vector<RunAcceleration>& accelerations_;
  ResultsWriter& writer_;
  StageCosts& costs_;
  const StopRequest& stop_ = watch_stop_signals();
  ProgressCounts counts_;
  std::size_t world_;  ///< index of the next world to be placed
  Thresholds thresholds_;
  std::mutex notes_mutex_;
  std::size_t warning_count_ = 0;
  std::vector<std::string> notes_;  ///< lines that the progress line's thread will print
  std::string lines_;               ///< JSON of worlds placed and not yet told
  std::optional<Error> error_;
  std::atomic<bool> failed_ = false;
  bool stop_told_ = false;
};

}  // namespace holdfast
