#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/exit_code.hpp"
#include "app/reading_guard.hpp"
#include "app/run_options.hpp"
#include "io/loads/load_choices.hpp"

/// What each command takes from the command line, and what does it; one source file per command.
namespace holdfast::internal {

struct ScreenOptions {
  std::optional<std::string> config_path;
  std::vector<std::string> layouts;
  std::vector<std::string> accelerations;
  std::string results_path = "results.h5";
  RunOptions run;
};
/// @param command_line as typed; the results file keeps it
ExitCode run_screen_command(const ScreenOptions& options, const std::string& command_line,
                            const ScreeningRunner& runner);

struct ConfigRunOptions {
  std::string config_path;
  RunOptions run;
};
ExitCode run_run_command(const ConfigRunOptions& options, const std::string& command_line);

struct MarginOptions {
  std::optional<std::string> config_path;
  std::vector<std::string> layouts;
  std::string results_path = "margins.h5";
  RunOptions run;
};
ExitCode run_margins_command(const MarginOptions& options, const std::string& command_line,
                             const ScreeningRunner& runner);

struct ServeOptions {
  std::optional<std::string> config_path;
  std::vector<std::string> accelerations;
  std::optional<std::string> norm;
  std::optional<std::string> engine;
  std::optional<std::string> accuracy;
  std::optional<int> threads;
  bool ordered = false;  ///< answers in the order of the lines
};
ExitCode run_serve_command(const ServeOptions& options);

struct MergeOptions {
  std::string results_path;
  std::vector<std::string> shards;  ///< files, and folders of them; empty: those beside the results file
  int threads = 0;                  ///< 0: one per core
  int memory = kReadingMemory;      ///< MB per thread
  bool overwrite = false;
  bool quiet = false;
};
ExitCode run_merge_command(const MergeOptions& options);

struct SummaryOptions {
  std::string results_path;
  std::optional<double> drop, move, tilt;  ///< thresholds, m, m and degrees; absent: those of the file
  std::optional<std::string> csv_folder;
  std::optional<std::string> output_path;
  int memory = kReadingMemory;  ///< MB
};
ExitCode run_summary_command(const SummaryOptions& options);

struct ReportOptions {
  std::string results_path;
  std::string output_path = "report.html";
  int most = 50;                ///< layouts that get a page
  int memory = kReadingMemory;  ///< MB
};
ExitCode run_report_command(const ReportOptions& options);

struct ViewOptions {
  std::string results_path;              ///< empty: none
  std::optional<std::string> page_path;  ///< absent: beside the results, with their name
  bool open = true;                      ///< in a browser
  bool serve = false;                    ///< on the loopback address, instead of writing a page
  int port = 0;                          ///< of `serve`; 0: one that is free
  int memory = kReadingMemory;           ///< MB
};
ExitCode run_view_command(const ViewOptions& options);

struct CheckOptions {
  std::optional<std::string> config_path;
  std::vector<std::string> paths;
  LoadChoices loads;
  bool bearing = false;  ///< list what rests on each box
};
ExitCode run_check_command(const CheckOptions& options);

struct BenchOptions {
  std::optional<std::string> config_path;
  std::vector<std::string> layouts;
  std::vector<std::string> accelerations;
  std::vector<std::string> engines;
  std::vector<int> threads;
  std::vector<std::size_t> classes;  ///< numbers of boxes at which layouts are divided into classes
  int repeats = 3;
  std::optional<std::string> folder;
  std::optional<std::string> csv_path;
};
ExitCode run_bench_command(const BenchOptions& options);

struct ValidateOptions {
  std::vector<std::string> engines;  ///< empty: all, as are suites
  std::vector<std::string> suites;
  std::optional<std::string> case_name;
  std::vector<std::string> layouts = {"configs/layouts"};
  bool quick = false;
  bool json = false;
  int threads = 0;  ///< 0: one per core
  std::optional<std::string> folder;
  std::optional<std::string> bounds_path;
  std::optional<std::string> record_path;
};
ExitCode run_validate_command(const ValidateOptions& options);
/// The names that the options for suites and cases accept.
std::vector<std::string> validation_suites();
std::vector<std::string> validation_cases();

/// @param devices also look for the devices of engines that run on some
ExitCode run_engines_command(bool devices);

ExitCode run_norms_command();
ExitCode run_containers_command();
ExitCode run_formats_command();

struct ConvertOptions {
  std::optional<std::string> config_path;
  std::vector<std::string> layouts;
  std::string output_path;
  LoadChoices loads;
  bool overwrite = false;
};
ExitCode run_convert_command(const ConvertOptions& options);

}  // namespace holdfast::internal
