#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/result_sink.hpp"
#include "io/results/chunk_grid.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_resume.hpp"
#include "io/results/run_description.hpp"

namespace holdfast::internal {

/// What the file gets of a unit of work, whose place in it is fixed. A unit is never split over two parts.
struct UnitPiece {
  AxisCounts end{};   ///< entries of the run, with the unit
  ColumnSet columns;  ///< its entries of the short datasets
  GridPiece piece;    ///< and of the long ones; its chunks are compressed by `SinkUnit::pack`
};

/// When the open part is closed: at the first limit reached.
struct PartLimits {
  std::size_t worlds = 256;
  std::size_t bytes = std::size_t{32} << 20U;
  std::chrono::steady_clock::duration age = std::chrono::seconds(2);
};

/// Writes a run's worlds into part files in `<path>.parts/`, so that a kill loses at most the open part. `assemble`
/// makes the results file from them.
///
/// `place` judges the worlds, and `SinkUnit::pack` compresses the unit's full chunks. After an error in writing every
/// later call returns the same one, and the parts finished before stay as they are. `close_part_if_due` may be called
/// from any thread at any time.
class ResultsWriter final : public ResultSink {
 public:
  /// Starts a new run, or continues after the finished parts of `resume` (see `find_finished`). An error if the results
  /// file exists already, if there are parts of another run, or if the folder cannot be created.
  static Result<std::unique_ptr<ResultsWriter>> open(const std::string& path, RunDescription run,
                                                     const Progress& resume = {}, const PartLimits& limits = {});
  /// Drops the open part; call `finish` first.
  ~ResultsWriter() override;

  std::unique_ptr<SinkUnit> place(UnitRecord& unit) override;
  /// Gives the worlds of a shard their place; they follow those that were placed before. Called as the other one.
  /// @param columns read for the entries that are `placed` now
  std::unique_ptr<SinkUnit> place(ColumnSet&& columns);

  /// Entries of the run that have their place.
  const AxisCounts& placed() const;

  /// Closes the open part if it is older than its limit.
  std::optional<Error> close_part_if_due(std::chrono::steady_clock::time_point now);

  /// Closes the open part, whatever its age: afterwards all worlds written are safe.
  std::optional<Error> finish() override;

 private:
  struct State;
  class Unit;
  explicit ResultsWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace holdfast::internal
