#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "app/commands.hpp"
#include "app/load_config.hpp"
#include "app/report.hpp"
#include "app/run_options.hpp"
#include "io/input/input_paths.hpp"

namespace holdfast::internal {

namespace {

struct ScreenOptions {
  std::optional<std::string> config_path;
  std::vector<std::string> layouts;
  std::vector<std::string> accelerations;
  std::string results_path = "results.h5";
  RunOptions run;
};

bool is_listed(const std::vector<std::string>& paths) {
  return std::find(paths.begin(), paths.end(), "-") != paths.end();
}

ExitCode screen(const ScreenOptions& options, const std::string& command_line) {
  const Result<Config> config = load_config(options.config_path);
  if (!config) return fail(ExitCode::bad_usage, config.errors());
  if (options.results_path.empty())
    return fail(ExitCode::bad_usage, {.what = "an empty path", .accepted = "the name of the results file"});
  if (is_listed(options.layouts) && is_listed(options.accelerations)) {
    return fail(ExitCode::bad_usage, {.what = "standard input can list the layouts or the accelerations, not both",
                                      .value = "-",
                                      .accepted = "name one of them by file or folder"});
  }
  std::vector<Error> warnings;
  const auto layouts = layout_paths(options.layouts, std::cin, warnings);
  if (!layouts) return fail(ExitCode::bad_usage, layouts.errors());
  const auto accelerations = acceleration_paths(options.accelerations, std::cin, warnings);
  if (!accelerations) return fail(ExitCode::bad_usage, accelerations.errors());
  warn(warnings);

  ScreeningJob job;
  job.settings = config->settings;
  job.config_text = config->text;
  job.layout_paths = *layouts;
  job.acceleration_paths = *accelerations;
  job.results_path = options.results_path;
  job.command_line = command_line;
  if (const auto wrong = options.run.apply_to(job)) return fail(ExitCode::bad_usage, *wrong);
  return run_screening(job);
}

}  // namespace

void add_screen_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("screen", "Simulate every layout under every acceleration");
  command->footer(
      "PATH is a regular file, a folder, or - for a list of paths on standard input.\n\n"
      "Example:\n"
      "  holdfast screen -c configs/demo.ini --layouts configs/layouts --accelerations configs/accelerations "
      "-o results.h5");
  auto options = std::make_shared<ScreenOptions>();
  command->add_option("-c,--config", options->config_path, "Configuration; see `holdfast --help-config`")
      ->type_name("FILE");
  command->add_option("--layouts", options->layouts, "Layouts")->required()->type_name("PATH");
  command->add_option("--accelerations", options->accelerations, "Accelerations")->required()->type_name("PATH");
  command->add_option("-o,--output", options->results_path, "Results file")->capture_default_str()->type_name("FILE");
  options->run.add_to(*command);
  command->callback(
      [options, &chosen] { chosen.run = [options, &chosen] { return screen(*options, chosen.command_line); }; });
}

}  // namespace holdfast::internal
