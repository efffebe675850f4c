#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/outcome_table.hpp"
#include "app/reading_guard.hpp"
#include "app/report.hpp"
#include "core/model/setting_table.hpp"
#include "io/results/analysis_tables.hpp"
#include "io/results/results_reader.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

/// Warns of files in the folder that a run with other analyses has left there: they stand beside those of this run.
std::vector<Error> tables_of_another_run(const std::string& folder, const ResultsInfo& info) {
  std::vector<Error> warnings;
  std::error_code unknown;
  for (const AnalysisTables* analysis : all_tables()) {
    const std::string path = fmt::format("{}/{}.csv", folder, analysis->name);
    if (analysis->csv != nullptr && !info.has(*analysis) && std::filesystem::exists(path, unknown))
      warnings.push_back({.file = path, .what = "is of another run, and stays as it is"});
  }
  return warnings;
}

ExitCode summarise(const SummaryOptions& options) {
  Result<ResultsReader> results = ResultsReader::open(options.results_path);
  if (!results) return fail(ExitCode::bad_usage, results.error());
  std::error_code unknown;
  if (options.output_path && std::filesystem::exists(*options.output_path, unknown)) {
    const bool folder = std::filesystem::is_directory(*options.output_path, unknown);
    return fail(ExitCode::bad_usage, {.file = *options.output_path,
                                      .what = folder ? "is a folder" : "exists already",
                                      .accepted = "the name of a new file"});
  }
  Thresholds thresholds = results->info().thresholds;
  thresholds.drop = options.drop.value_or(thresholds.drop);
  thresholds.move = options.move.value_or(thresholds.move);
  thresholds.tilt = options.tilt.value_or(thresholds.tilt);

  if (!results->info().complete) {
    warn(std::vector{Error{.file = options.results_path,
                           .what = "is a part of an unfinished run, and holds some of its worlds",
                           .accepted = "`holdfast screen --resume` finishes the run"}});
  }

  const Result<OutcomeTable> table = outcome_table(*results, thresholds);
  if (!table) return fail(ExitCode::some_failed, table.error());
  const Result<std::string> analyses = analysis_tables(*results);
  if (!analyses) return fail(ExitCode::some_failed, analyses.error());
  print_to(stdout, "thresholds: drop {} m, move {} m, tilt {} degrees\n{}{}", thresholds.drop, thresholds.move,
           thresholds.tilt, table->text, *analyses);
  if (options.csv_folder) {
    if (const auto error = write_summary_csv(options.results_path, thresholds, *options.csv_folder))
      return fail(ExitCode::some_failed, *error);
    warn(tables_of_another_run(*options.csv_folder, results->info()));
  }
  if (options.output_path) {
    if (const auto error = write_summary(options.results_path, thresholds, *options.output_path))
      return fail(ExitCode::some_failed, *error);
  }
  return ExitCode::done;
}

}  // namespace

ExitCode run_summary_command(const SummaryOptions& options) {
  for (const auto& path : {options.csv_folder, options.output_path})
    if (path && path->empty())
      return fail(ExitCode::bad_usage, {.what = "an empty path", .accepted = "the name of what is to be written"});
  return guard_reading({.path = options.results_path, .cure = "simulate again", .memory = options.memory},
                       [&] { return summarise(options); });
}

}  // namespace holdfast::internal
