#include <iostream>

#include "app/commands.hpp"
#include "app/load_config.hpp"
#include "app/report.hpp"
#include "io/input/input_paths.hpp"

namespace holdfast::internal {

ExitCode run_margins_command(const MarginOptions& options, const std::string& command_line,
                             const ScreeningRunner& runner) {
  const Result<Config> config = load_config(options.config_path);
  if (!config) return fail(ExitCode::bad_usage, config.errors());
  if (options.results_path.empty())
    return fail(ExitCode::bad_usage, {.what = "an empty path", .accepted = "the name of the results file"});
  std::vector<Error> warnings;
  const auto layouts = layout_paths(options.layouts, std::cin, warnings);
  if (!layouts) return fail(ExitCode::bad_usage, layouts.errors());
  warn(warnings);

  ScreeningJob job;
  job.settings = config->settings;
  job.config_text = config->text;
  job.layout_paths = *layouts;
  job.results_path = options.results_path;
  job.command_line = command_line;
  if (const auto wrong = options.run.apply_to(job, *config)) return fail(ExitCode::bad_usage, *wrong);
  job.settings.screening.margins = true;
  job.record_series = false;
  return runner(job);
}

}  // namespace holdfast::internal
