#include <filesystem>
#include <iostream>

#include "app/commands.hpp"
#include "app/load_config.hpp"
#include "app/report.hpp"
#include "app/run_options.hpp"
#include "io/input/input_paths.hpp"

namespace holdfast::internal {

namespace {

/// The inputs that a configuration names: its batch folder, or its single pair.
Result<BatchFolder> inputs_of(const Config& config, std::vector<Error>& warnings) {
  const Settings& settings = config.settings;
  if (settings.batch_simulation) return read_batch_folder(settings.batch_path, warnings);
  if (settings.screening.layout.empty() || settings.screening.acceleration.empty()) {
    return Error{.file = config.path,
                 .what = "names nothing to run",
                 .accepted = "give [Screening] Layout and Acceleration, or BatchSimulation = true and BatchPath"};
  }
  const auto layouts = layout_paths(std::vector{settings.screening.layout}, std::cin, warnings);
  if (!layouts) return layouts.errors();
  const auto accelerations = acceleration_paths(std::vector{settings.screening.acceleration}, std::cin, warnings);
  if (!accelerations) return accelerations.errors();
  return BatchFolder{*layouts, *accelerations};
}

}  // namespace

ExitCode run_run_command(const ConfigRunOptions& options, const std::string& command_line) {
  const Result<Config> config = load_config(options.config_path);
  if (!config) return fail(ExitCode::bad_usage, config.errors());
  std::vector<Error> warnings;
  const Result<BatchFolder> inputs = inputs_of(*config, warnings);
  if (!inputs) return fail(ExitCode::bad_usage, inputs.errors());
  warn(warnings);

  const std::filesystem::path folder = config->settings.save_path;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return fail(ExitCode::bad_usage, {.file = options.config_path,
                                      .what = "SavePath cannot be created",
                                      .value = folder.string(),
                                      .accepted = error.message()});
  }

  ScreeningJob job;
  job.settings = config->settings;
  job.config_text = config->text;
  job.layout_paths = inputs->layouts;
  job.acceleration_paths = inputs->accelerations;
  job.results_path = (folder / "results.h5").string();
  job.command_line = command_line;
  if (config->settings.batch_simulation) job.batch_name = config->settings.batch_path;
  if (const auto wrong = options.run.apply_to(job)) return fail(ExitCode::bad_usage, *wrong);
  if (!job.text_folder && job.record_series) job.text_folder = folder.string();
  return run_screening(job);
}

}  // namespace holdfast::internal
