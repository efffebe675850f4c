#include "app/run_options.hpp"

namespace holdfast {

void RunOptions::add_to(CLI::App& command) {
  command.add_option("--engine", engine, "Engine that moves the boxes; see `holdfast engines`")->type_name("NAME");
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
  command.add_flag("--json", json,
                   "Print one JSON object a world as it finishes, with --resume the finished ones first");
  command.add_flag("--quiet", quiet, "No progress, no table; errors only");
}

void RunOptions::apply_to(ScreeningJob& job) const {
  ScreeningSettings& screening = job.settings.screening;
  screening.engine = engine.value_or(screening.engine);
  screening.threads = threads.value_or(screening.threads);
  screening.scheduler = scheduler.value_or(screening.scheduler);
  if (text_folder) job.text_folder = text_folder;
  job.costs_path = costs_path;
  job.record_series = !no_series;
  job.resume = resume;
  job.overwrite = overwrite;
  job.json = json;
  job.quiet = quiet;
}

}  // namespace holdfast
