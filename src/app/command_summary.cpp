#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "app/commands.hpp"
#include "app/outcome_table.hpp"
#include "app/reading_guard.hpp"
#include "app/report.hpp"
#include "core/model/setting_table.hpp"
#include "io/results/results_reader.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

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
  }
  if (options.output_path) {
    if (const auto error = write_summary(options.results_path, thresholds, *options.output_path))
      return fail(ExitCode::some_failed, *error);
  }
  return ExitCode::done;
}

}  // namespace

ExitCode run_summary_command(const SummaryOptions& options) {
  return guard_reading({.path = options.results_path, .cure = "simulate again", .memory = options.memory},
                       [&] { return summarise(options); });
}

}  // namespace holdfast::internal
