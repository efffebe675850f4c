#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "parallel/screening/stage_costs.hpp"

namespace holdfast::internal {

/// One way of running a set of worlds: what a benchmark compares.
struct BenchCase {
  std::string engine;
  std::string set;                   ///< name of the set of layouts, such as "all" or "50-99 boxes"
  std::vector<std::string> layouts;  ///< paths
  int threads = 1;
  bool series = true;  ///< whether time series are recorded
};

/// What one run of a case took.
struct BenchSample {
  double wall_seconds = 0.0;       ///< of the process, from its start to its end
  double cpu_seconds = 0.0;        ///< of the process, all threads
  double simulated_seconds = 0.0;  ///< over all worlds
  double peak_memory = 0.0;        ///< MiB
  double file_size = 0.0;          ///< of the results file, MiB
  std::uint64_t worlds = 0;
  std::uint64_t boxes = 0;          ///< over all worlds
  std::uint64_t steps = 0;          ///< over all worlds
  std::uint64_t steps_skipped = 0;  ///< of these
  std::uint64_t box_steps = 0;      ///< steps times boxes, over all worlds
  StageSeconds stages{};            ///< processor seconds
  std::string hash;                 ///< of all final states and of what the boxes' ends and peaks are judged by
};

/// Everything that is the same for all cases.
struct BenchInputs {
  std::optional<std::string> config_path;
  std::vector<std::string> accelerations;  ///< paths
  std::string folder;                      ///< for the results, which are removed again
};

/// Runs a case in a process of its own, `holdfast screen`, as a user would: so its memory and time are its own.
/// Returns an error when a world fails, or when the process does; the process prints the reason on standard error.
/// @param stop ends the process, and the case with an error
Result<BenchSample> run_bench_case(const BenchCase& bench_case, const BenchInputs& inputs,
                                   const std::atomic<bool>& stop);

}  // namespace holdfast::internal
