#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/world_record.hpp"
#include "core/model/layout.hpp"
#include "io/results/chunk_grid.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/results_resume.hpp"
#include "io/results/run_description.hpp"

namespace holdfast {

/// A layout as the results file keeps it. A bad layout has no boxes.
struct LayoutRecord {
  std::uint64_t index = 0;  ///< in the run
  Layout layout;
};

/// The finished worlds of one unit of work: what the writer takes at a time, and never splits over two parts.
struct UnitRecord {
  std::vector<LayoutRecord> layouts;  ///< those whose first world is in this unit, by rising index
  std::vector<WorldRecord> worlds;    ///< in the order of the file
  std::vector<Error> warnings;        ///< of the layouts, for the user; not kept in the file
};

/// A unit whose place in the file is fixed.
struct PlacedUnit {
  UnitRecord record;  ///< without its series
  AxisCounts end{};   ///< entries of the run, with the unit
  ColumnSet columns;  ///< its entries of the short datasets
  GridPiece piece;    ///< and of the long ones
};

/// A unit whose chunks are compressed as the file will hold them.
struct PackedUnit : PlacedUnit {};

/// When the open part is closed: at the first limit reached.
struct PartLimits {
  std::size_t worlds = 256;
  std::size_t bytes = std::size_t{32} << 20U;
  std::chrono::steady_clock::duration age = std::chrono::seconds(2);
};

/// Writes a run's worlds into part files under `<path>.parts/`, so that a kill costs the open part at most.
/// `assemble` makes the results file of them.
///
/// Units pass three stages. `place` and `write` are each called by one thread at a time, in the order of the
/// worlds; `pack` by any thread. `close_part_if_due` may be called from any thread at any time.
class ResultsWriter {
 public:
  /// Starts a new run, or goes on after the finished parts of `resume` (see `find_finished`). An error when the
  /// results file exists already, when parts of another run are in the way, or when the folder cannot be made.
  static Result<std::unique_ptr<ResultsWriter>> open(const std::string& path, RunDescription run,
                                                     const Progress& resume = {}, const PartLimits& limits = {});
  ResultsWriter(const ResultsWriter&) = delete;
  ResultsWriter& operator=(const ResultsWriter&) = delete;
  /// Drops the open part; call `finish` first.
  ~ResultsWriter();

  /// Judges the unit's worlds and gives them their place in the file.
  PlacedUnit place(UnitRecord&& unit);

  /// Compresses the unit's full chunks. Pure.
  static PackedUnit pack(PlacedUnit&& unit);

  /// Adds the unit to the open part; closes the part when it is due. After an error every later call returns
  /// the same one, and the parts finished before stay as they are.
  std::optional<Error> write(PackedUnit&& unit);

  /// Closes the open part when it has become older than its limit.
  std::optional<Error> close_part_if_due(std::chrono::steady_clock::time_point now);

  /// Closes the open part, whatever its age: afterwards all worlds written are safe.
  std::optional<Error> finish();

 private:
  struct State;
  explicit ResultsWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace holdfast
