#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/bench/bench_run.hpp"

namespace holdfast::internal {

/// All runs of a case.
struct BenchRow {
  BenchCase bench_case;
  std::vector<BenchSample> samples;  ///< one per repetition
};

/// An error when runs of the same engine and the same worlds have different hashes. Scheduling, recording and
/// repetition must not change a result.
std::optional<Error> check_same_results(const std::vector<BenchRow>& rows);

/// What `holdfast bench` prints: medians of each case, with the spread of its runs; efficiency against the fewest
/// threads of the same engine, set and recording; and the shares of processor time by stage.
std::string bench_tables(const std::vector<BenchRow>& rows);

/// One line per run, with all figures; for plots and other programs.
std::string bench_csv(const std::vector<BenchRow>& rows);

/// What keeps `bench_csv` from being written there, if anything.
std::optional<Error> check_bench_csv(const std::string& path);

}  // namespace holdfast::internal
