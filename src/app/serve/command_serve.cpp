#include <algorithm>
#include <cstddef>
#include <iostream>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/load_config.hpp"
#include "app/norm_option.hpp"
#include "app/report.hpp"
#include "app/run_inputs.hpp"
#include "app/serve/layout_service.hpp"
#include "app/stop_signal.hpp"
#include "holdfast/holdfast.hpp"
#include "io/input/input_paths.hpp"
#include "parallel/schedulers/scheduler.hpp"

namespace holdfast::internal {

namespace {

ExitCode fail(const holdfast::Error& error) {
  for (const holdfast::Problem& problem : error.problems()) print_to(stderr, "{}\n", problem.message);
  return ExitCode::bad_usage;
}

}  // namespace

ExitCode run_serve_command(const ServeOptions& options) {
  const Result<Config> config = load_config(options.config_path);
  if (!config) return fail(ExitCode::bad_usage, config.errors());
  if (std::find(options.accelerations.begin(), options.accelerations.end(), "-") != options.accelerations.end())
    return fail(ExitCode::bad_usage, {.what = "standard input brings the layouts, and cannot list accelerations",
                                      .value = "-",
                                      .accepted = "name them by file or folder"});
  Settings settings = config->settings;
  if (const auto wrong = apply_norm(options.norm, settings)) return fail(ExitCode::bad_usage, *wrong);
  std::vector<Error> warnings;
  const auto paths = files_beside_norm(options.accelerations, settings, warnings);
  if (!paths) return fail(ExitCode::bad_usage, paths.errors());
  warn(warnings);
  warn_of_same_names(*paths);

  try {
    std::vector<holdfast::Acceleration> accelerations;
    if (const std::string norm = std::exchange(settings.screening.norm, ""); !norm.empty()) {
      print_to(stderr, "{}", norm_text(norm));
      accelerations = holdfast::norm_accelerations(norm);
    }
    for (const std::string& path : *paths) accelerations.push_back(holdfast::read_acceleration(path));
    const int threads = thread_count(options.threads.value_or(config->settings.screening.threads));
    // The service gives each screen the accelerations that it needs, those of the norm among them.
    LayoutService service(std::move(accelerations),
                          {.config = config->text,
                           .norm = "",
                           .engine = options.engine,
                           .accuracy = options.accuracy,
                           .threads = options.threads},
                          settings, static_cast<std::size_t>(threads), options.ordered, watch_stop_signals());
    return service.run();
  } catch (const holdfast::Error& error) {
    return fail(error);
  }
}

}  // namespace holdfast::internal
