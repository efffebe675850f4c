#include "app/run_options.hpp"

#include <fmt/format.h>

#include "core/engine/engine_registry.hpp"
#include "core/model/setting_table.hpp"
#include "parallel/schedulers/scheduler.hpp"

namespace holdfast::internal {

void RunOptions::add_to(CLI::App& command) {
  command.add_option("--engine", engine, "Engine that moves the boxes; see `holdfast engines`")->type_name("NAME");
  command
      .add_option("--accuracy", accuracy,
                  "How far the native engine goes: screening, standard or reference; stands in for [Native] Accuracy")
      ->type_name("NAME");
  command.add_option("--threads", threads, "Threads; 0: one a core")->check(CLI::Range(0, 1024))->type_name("N");
  command.add_option("--scheduler", scheduler, "How work is spread over threads: tbb, openmp or serial")
      ->type_name("NAME");
  command.add_option("--text", text_folder, "Also write the three kinds of text files into this folder")
      ->type_name("DIR");
  command.add_option("--costs", costs_path, "Write the processor seconds of reading, simulating, writing, ... as JSON")
      ->type_name("FILE");
  command.add_flag("--no-series", no_series, "Keep end states and peaks only, no time series");
  auto* go_on = command.add_flag("--resume", resume, "Go on with a run that was stopped or killed");
  command.add_flag("--overwrite", overwrite, "Replace the results of an earlier run")->excludes(go_on);
  command.add_flag(
      "--json", json,
      "Print one JSON object per world, with its verdict, as it finishes; with --resume the finished ones first");
  command.add_flag("--quiet", quiet, "No progress, no table; errors only");
}

std::optional<Error> RunOptions::apply_to(ScreeningJob& job) const {
  ScreeningSettings& screening = job.settings.screening;
  screening.engine = engine.value_or(screening.engine);
  screening.threads = threads.value_or(screening.threads);
  if (scheduler) {
    const SettingKey& key = *find_setting("Screening", "Scheduler");
    if (!key.set(job.settings, 0, *scheduler))
      return Error{.what = "unknown scheduler",
                   .value = *scheduler,
                   .accepted = fmt::format("accepted are {}", fmt::join(scheduler_names(), ", "))};
  }
  if (text_folder) job.text_folder = text_folder;
  job.costs_path = costs_path;
  job.record_series = !no_series;
  if (resume) job.existing = ExistingResults::resume;
  if (overwrite) job.existing = ExistingResults::overwrite;
  job.json = json;
  job.quiet = quiet;
  return apply_accuracy(job.settings);
}

std::optional<Error> RunOptions::apply_accuracy(Settings& settings) const {
  return accuracy ? set_accuracy(settings, *accuracy) : std::nullopt;
}

}  // namespace holdfast::internal
