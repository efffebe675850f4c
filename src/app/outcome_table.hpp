#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/base/result.hpp"
#include "core/model/verdict.hpp"
#include "io/results/results_reader.hpp"

namespace holdfast::internal {

/// The outcome of a run for a reader at a terminal.
struct OutcomeTable {
  std::string text;                 ///< lines, with a newline at the end
  std::uint64_t failed_worlds = 0;  ///< whose status is not ok
};

/// Per acceleration how many layouts stayed, moved, fell and were unstable; the worst worlds by name; the layouts that
/// were unstable before any acceleration; what failed; the shares of steps skipped and of simulated time saved. Of a
/// complete results file, under the given thresholds.
/// @param planned_ends when a world ends that does not end early, one per acceleration, s; empty where that is not
/// known:
///                    the share of time saved is then left out
Result<OutcomeTable> outcome_table(ResultsReader& results, const Thresholds& thresholds,
                                   std::span<const double> planned_ends = {});

/// The tables of the analyses that the file has.
Result<std::string> analysis_tables(ResultsReader& results);

}  // namespace holdfast::internal
