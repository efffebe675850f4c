#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/exit_code.hpp"
#include "core/model/settings.hpp"

namespace holdfast {

/// One screening run: every layout under every acceleration.
struct ScreeningJob {
  Settings settings;
  std::string config_text;  ///< of the configuration file, kept in the results; may be empty
  std::vector<std::string> layout_paths;
  std::vector<std::string> acceleration_paths;
  std::string results_path;
  std::optional<std::string> text_folder;  ///< write the three text files there
  std::string batch_name = "batch";        ///< names the text file of the batch
  std::string command_line;                ///< as typed
  bool record_series = true;
  bool resume = false;
  bool overwrite = false;
  std::optional<std::string> costs_path;  ///< write there where the processor time went
  bool json = false;   ///< one JSON object a world on standard output, finished ones first; nothing else there
  bool quiet = false;  ///< no progress, no table
};

/// Runs the job: simulates, writes the results file, prints the outcome. Returns the exit code; what went wrong
/// is on standard error, a line each.
ExitCode run_screening(const ScreeningJob& job);

}  // namespace holdfast
