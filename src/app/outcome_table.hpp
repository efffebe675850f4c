#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.hpp"
#include "core/model/verdict.hpp"

namespace holdfast::internal {

/// The outcome of a run for a reader at a terminal.
struct OutcomeTable {
  std::string text;                 ///< lines, with a newline at the end
  std::uint64_t failed_worlds = 0;  ///< whose status is not ok
};

/// Per acceleration how many layouts stayed, moved, fell and were unstable; the worst worlds by name; the layouts that
/// were unstable before any acceleration; what failed; the share of steps skipped. From a complete results file, under
/// the given thresholds.
Result<OutcomeTable> outcome_table(const std::string& results_path, const Thresholds& thresholds);

}  // namespace holdfast::internal
