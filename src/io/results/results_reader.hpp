#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/world_record.hpp"
#include "core/model/verdict.hpp"
#include "io/results/analysis_tables.hpp"

namespace holdfast::internal {

/// Entries that consecutive rows of a table have in a column of their boxes or samples.
struct EntryRange {
  std::uint64_t begin = 0;
  std::vector<std::size_t> counts;  ///< per row
};

/// The description of a run in its results file.
struct ResultsInfo {
  std::string path;           ///< as it was opened, for messages
  std::uint64_t version = 0;  ///< of its format
  std::string software;
  std::string git_commit;
  std::string engine;
  std::string command_line;
  std::string created_utc;
  std::string host;
  std::string fingerprint;
  bool complete = false;           ///< false for a part
  Thresholds thresholds;           ///< of the run, and of its summary
  std::string norm;                ///< of the run; empty: none
  RunTables analyses;              ///< what the run was asked for beside the verdicts
  std::uint64_t world_begin = 0;   ///< index in the run of the file's first world; 0 unless a part
  std::uint64_t layout_begin = 0;  ///< index in the run of the file's first layout; 0 unless a part
  std::uint64_t world_count = 0;
  std::uint64_t box_count = 0;
  std::vector<std::string> layouts;        ///< names, from `layout_begin` on
  std::vector<std::string> accelerations;  ///< names

  bool has(const AnalysisTables& tables) const {
    return std::find(analyses.begin(), analyses.end(), &tables) != analyses.end();
  }

  /// Files of versions 1 and 2 have no peaks: their worlds are judged by where boxes are at the end.
  bool judged_at_end() const { return version < 3; }

  /// How its worlds are judged by other thresholds, or by its own.
  Judging judging(const Thresholds& limits) const { return {limits, thresholds, judged_at_end()}; }

  /// Names of a world's inputs; for a layout that is not described in the file (a part), its index.
  std::string layout_name(std::uint64_t layout) const;
  std::string acceleration_name(std::uint64_t acceleration) const;
};

namespace h5 {
class File;
}

/// Worlds that are read and held in memory at a time by what goes through all worlds of a file.
inline constexpr std::uint64_t kSliceWorlds = 1024;

/// Calls of HDF5 that have returned: while it grows, a process that reads makes progress. A signal handler may ask.
std::uint64_t results_calls_returned();

/// Reads a results file, or a single part of one. Used by one thread at a time.
class ResultsReader {
 public:
  /// An error if the file cannot be opened, is not a results file, or has a later format.
  static Result<ResultsReader> open(const std::string& path);

  /// Reads a file that is still being written; `file` must outlive the reader. For src/io only.
  static Result<ResultsReader> attach(const h5::File& file);

  ResultsReader(ResultsReader&&) noexcept;
  ResultsReader& operator=(ResultsReader&&) noexcept;
  ~ResultsReader();

  const ResultsInfo& info() const;

  /// Every effective setting of the run, as `Section/Key` and its text.
  Result<std::vector<std::pair<std::string, std::string>>> settings() const;

  /// Rows [begin, begin + count) of /worlds. Their begin indices are indices in the file, also for a part. In a file of
  /// version 1 the residual is a ratio, whose scale is 1.
  Result<std::vector<WorldRow>> worlds(std::uint64_t begin, std::uint64_t count);

  /// Whether the file has a dataset of the schema; those of earlier versions do not have all.
  bool has(std::string_view path) const;

  /// Entries [begin, begin + count) of a dataset of the schema, in their stored form.
  Result<std::vector<std::byte>> stored(std::string_view path, std::uint64_t begin, std::uint64_t count);

  /// Where the boxes of consecutive layouts of the file are, along the axis of boxes of layouts.
  Result<EntryRange> layout_boxes(std::uint64_t begin, std::size_t count);

  /// Rows [begin, begin + count) of /boxes: properties and end values of boxes.
  Result<BoxTable> boxes(std::uint64_t begin, std::uint64_t count);
  Result<EndTable> ends(std::uint64_t begin, std::uint64_t count);

  /// The series of a world; empty when not recorded.
  Result<Series> series(const WorldRow& world);

 private:
  struct State;
  explicit ResultsReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace holdfast::internal
