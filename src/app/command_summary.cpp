#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "app/commands.hpp"
#include "app/crash_guard.hpp"
#include "app/outcome_table.hpp"
#include "app/report.hpp"
#include "core/model/setting_table.hpp"
#include "io/results/results_reader.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

struct SummaryOptions {
  std::string results_path;
  std::optional<double> drop, move, tilt;
  std::optional<std::string> csv_folder;
  std::optional<std::string> output_path;
};

/// Has an option take what the configuration's key takes.
CLI::Validator as_in_config(const char* section, const char* name) {
  const SettingKey& key = *find_setting(section, name);
  return {[&key](const std::string& text) {
            Settings ignored;
            return key.set(ignored, 0, text) ? "" : fmt::format("{}; accepted is {}", text, key.accepted);
          },
          ""};
}

ExitCode summarise(const SummaryOptions& options) {
  const Result<ResultsReader> results = ResultsReader::open(options.results_path);
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

  const Result<OutcomeTable> table = outcome_table(options.results_path, thresholds);
  if (!table) return fail(ExitCode::some_failed, table.error());
  print_to(stdout, "thresholds: drop {} m, move {} m, tilt {} degrees\n{}", thresholds.drop, thresholds.move,
           thresholds.tilt, table->text);
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

void add_summary_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("summary", "Judge a results file again, with other thresholds if given");
  command->footer(
      "The results file itself is never changed.\n\n"
      "Example:\n"
      "  holdfast summary results.h5 --move-threshold 0.05 --csv tables/");
  auto options = std::make_shared<SummaryOptions>();
  command->add_option("results", options->results_path, "Results file")->required()->type_name("FILE");
  command->add_option("--drop-threshold", options->drop, "Fallen when lower by more, m")
      ->check(as_in_config("Simulation Settings", "DropThreshold"));
  command->add_option("--move-threshold", options->move, "Moved when displaced by more, m")
      ->check(as_in_config("Screening", "MoveThreshold"));
  command->add_option("--tilt-threshold", options->tilt, "Tilted when rotated by more, degrees")
      ->check(as_in_config("Screening", "TiltThreshold"));
  command->add_option("--csv", options->csv_folder, "Write worlds.csv and boxes.csv into this folder")
      ->type_name("DIR");
  command->add_option("-o,--output", options->output_path, "Write the tables into this new HDF5 file")
      ->type_name("FILE");
  command->callback([options, &chosen] {
    chosen.run = [options] {
      return guard_reading(
          options->results_path, [&] { return summarise(*options); }, "simulate again");
    };
  });
}

}  // namespace holdfast::internal
