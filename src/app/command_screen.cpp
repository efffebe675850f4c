#include <algorithm>
#include <iostream>
#include <optional>

#include "app/commands.hpp"
#include "app/load_config.hpp"
#include "app/norm_option.hpp"
#include "app/report.hpp"
#include "app/run_options.hpp"
#include "io/input/input_paths.hpp"

namespace holdfast::internal {

namespace {

bool is_listed(const std::vector<std::string>& paths) {
  return std::find(paths.begin(), paths.end(), "-") != paths.end();
}

}  // namespace

ExitCode run_screen_command(const ScreenOptions& options, const std::string& command_line,
                            const ScreeningRunner& runner) {
  const Result<Config> config = load_config(options.config_path);
  if (!config) return fail(ExitCode::bad_usage, config.errors());
  if (options.results_path.empty())
    return fail(ExitCode::bad_usage, {.what = "an empty path", .accepted = "the name of the results file"});
  if (is_listed(options.layouts) && is_listed(options.accelerations)) {
    return fail(ExitCode::bad_usage, {.what = "standard input can list the layouts or the accelerations, not both",
                                      .value = "-",
                                      .accepted = "name one of them by file or folder"});
  }
  ScreeningJob job;
  job.settings = config->settings;
  if (const auto wrong = options.run.apply_to(job, *config)) return fail(ExitCode::bad_usage, *wrong);
  std::vector<Error> warnings;
  const auto layouts = layout_paths(options.layouts, std::cin, warnings);
  if (!layouts) return fail(ExitCode::bad_usage, layouts.errors());
  const auto accelerations = files_beside_norm(options.accelerations, job.settings, warnings);
  if (!accelerations) return fail(ExitCode::bad_usage, accelerations.errors());
  warn(warnings);

  job.config_text = config->text;
  job.layout_paths = *layouts;
  job.acceleration_paths = *accelerations;
  job.results_path = options.results_path;
  job.command_line = command_line;
  return runner(job);
}

}  // namespace holdfast::internal
