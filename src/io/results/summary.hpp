#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/verdict.hpp"
#include "io/results/results_reader.hpp"

namespace holdfast::internal {

/// The summary of some consecutive worlds and all their boxes.
struct SummarySlice {
  std::uint64_t world_begin = 0;  ///< row of /worlds of the first one
  std::uint64_t box_begin = 0;    ///< row of /boxes of their first box
  std::vector<WorldRow> rows;
  std::vector<WorldVerdict> worlds;
  EndTable ends;
  std::vector<BoxVerdict> boxes;
};

/// Judgement on the boxes of a world.
std::vector<BoxVerdict> judge_boxes(const EndTable& end, const Judging& judging);

/// Derives the summary of all worlds in slices, in the order of the file; memory does not grow with the file.
/// Used for other thresholds, and for printing; the summary in a results file is derived when each world finishes.
/// @param visit returns an error to stop
std::optional<Error> derive_summary(ResultsReader& results, const Thresholds& thresholds,
                                    const std::function<std::optional<Error>(const SummarySlice&)>& visit);

/// Writes the summary for other thresholds into a new HDF5 file, with the names that are needed to read it; attributes
/// name the results file. Never overwrites a file; refuses a part, because a part repeats boxes of others.
std::optional<Error> write_summary(const std::string& results_path, const Thresholds& thresholds,
                                   const std::string& path);

/// Writes `worlds.csv` and `boxes.csv` into the folder, and what analyses add: files of their own, such as
/// `margins.csv`, and columns at the end of the first two. The folder is created if it is missing; existing files are
/// replaced. RFC 4180, one header line, units at the end of the names (`drop_m`). pandas.read_csv needs no options.
std::optional<Error> write_summary_csv(const std::string& results_path, const Thresholds& thresholds,
                                       const std::string& folder);

}  // namespace holdfast::internal
