#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/recorded_run.hpp"
#include "app/exit_code.hpp"
#include "core/model/settings.hpp"
#include "io/input/layout_files.hpp"

namespace holdfast::internal {

/// Which of how many shards.
struct ShardChoice {
  std::uint64_t part = 1;  ///< from 1
  std::uint64_t parts = 1;
};

/// One screening run: every layout under every acceleration.
struct ScreeningJob {
  Settings settings;
  std::string config_text;  ///< of the configuration file, kept in the results; may be empty
  std::vector<std::string> layout_paths;
  std::shared_ptr<LayoutFiles> layouts;         ///< those of a shard; absent: all of `layout_paths`
  std::vector<std::string> acceleration_paths;  ///< without them and a norm: gravity alone
  std::string results_path;
  std::optional<std::string> text_folder;  ///< write the three text files there
  std::string batch_name = "batch";        ///< names the text file of the batch
  std::string command_line;                ///< as typed
  std::optional<ShardChoice> part;  ///< simulate one of several shards alone, into `shard_path(results_path, ...)`
  std::optional<ShardOfRun> shard;  ///< of a job that is one
  bool record_series = true;
  ExistingResults existing = ExistingResults::refuse;
  std::optional<std::string> costs_path;  ///< write there where the processor time went
  bool json = false;   ///< one JSON object per world on standard output, finished ones first; nothing else there
  bool quiet = false;  ///< no progress, no table
};

/// "1 layout", "2 layouts".
std::string counted(std::size_t count, std::string_view noun);

/// What becomes of a job that a command has put together: `run_screening`, or a distribution over many processes.
using ScreeningRunner = std::function<ExitCode(const ScreeningJob&)>;

/// Runs the job: simulates, writes the results file, prints the outcome. Returns the exit code; errors are on standard
/// error, one per line.
ExitCode run_screening(const ScreeningJob& job);

}  // namespace holdfast::internal
