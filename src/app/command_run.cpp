#include <filesystem>
#include <iostream>

#include "app/commands.hpp"
#include "app/load_config.hpp"
#include "app/report.hpp"
#include "app/run_options.hpp"
#include "io/input/input_paths.hpp"

namespace holdfast::internal {

namespace {

/// The files that a configuration names: its batch folder, or its single pair. With a norm there may be none of
/// accelerations.
/// @param path of the configuration
Result<BatchFolder> inputs_of(const Settings& settings, const std::string& path, std::vector<Error>& warnings) {
  const bool has_norm = !settings.screening.norm.empty();
  if (settings.batch_simulation) return read_batch_folder(settings.batch_path, !has_norm, warnings);
  const std::string& acceleration = settings.screening.acceleration;
  if (settings.screening.layout.empty() || (acceleration.empty() && !has_norm)) {
    return Error{
        .file = path,
        .what = "names nothing to run",
        .accepted = "give [Screening] Layout and Acceleration or Norm, or BatchSimulation = true and BatchPath"};
  }
  const auto layouts = layout_paths(std::vector{settings.screening.layout}, std::cin, warnings);
  if (!layouts) return layouts.errors();
  if (acceleration.empty()) return BatchFolder{*layouts, {}};
  const auto accelerations = acceleration_paths(std::vector{acceleration}, std::cin, warnings);
  if (!accelerations) return accelerations.errors();
  return BatchFolder{*layouts, *accelerations};
}

}  // namespace

ExitCode run_run_command(const ConfigRunOptions& options, const std::string& command_line) {
  const Result<Config> config = load_config(options.config_path);
  if (!config) return fail(ExitCode::bad_usage, config.errors());
  ScreeningJob job;
  job.settings = config->settings;
  // StableCargo's files keep their numbers: worlds begin and end with the acceleration.
  if (!config->given.contains({"Screening", "SettleSeconds"})) job.settings.screening.settle_seconds = 0.0;
  if (!config->given.contains({"Screening", "RunOutSeconds"})) job.settings.screening.run_out_seconds = 0.0;
  if (const auto wrong = options.run.apply_to(job, *config)) return fail(ExitCode::bad_usage, *wrong);
  std::vector<Error> warnings;
  const Result<BatchFolder> inputs = inputs_of(job.settings, config->path, warnings);
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

  job.config_text = config->text;
  job.layout_paths = inputs->layouts;
  job.acceleration_paths = inputs->accelerations;
  job.results_path = (folder / "results.h5").string();
  job.command_line = command_line;
  if (config->settings.batch_simulation) job.batch_name = config->settings.batch_path;
  if (!job.text_folder && job.record_series) job.text_folder = folder.string();
  return run_screening(job);
}

}  // namespace holdfast::internal
