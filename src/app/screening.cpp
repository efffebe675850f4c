#include "app/screening.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "analyses/analysis.hpp"
#include "api/engine_loader.hpp"
#include "api/recorded_run.hpp"
#include "app/outcome_table.hpp"
#include "app/reading_guard.hpp"
#include "app/report.hpp"
#include "app/run_inputs.hpp"
#include "app/shard_job.hpp"
#include "app/stage_costs_file.hpp"
#include "app/stop_signal.hpp"
#include "app/terminal_observer.hpp"
#include "core/engine/journey.hpp"
#include "io/export/text_export.hpp"
#include "io/input/layout_files.hpp"
#include "io/input/text_file.hpp"
#include "io/results/output_lock.hpp"
#include "io/results/results_resume.hpp"
#include "parallel/schedulers/scheduler.hpp"

namespace holdfast::internal {

namespace {

/// The full path of a file that need not be there, without links.
std::filesystem::path place_of(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path, unknown), unknown);
}

/// An error when the files beside the results could not be written; reported before the run.
std::optional<Error> check_side_files(const ScreeningJob& job, const RunDescription& description) {
  if (job.costs_path) {
    if (place_of(*job.costs_path) == place_of(job.results_path))
      return Error{.file = *job.costs_path, .what = "is the results file", .accepted = "another name"};
    if (auto error = check_costs_file(*job.costs_path)) return error;
  }
  if (!job.text_folder) return std::nullopt;
  std::vector<std::string> accelerations;
  for (const Acceleration& acceleration : description.accelerations) accelerations.push_back(acceleration.name);
  return prepare_text_export(*job.text_folder, description.layout_names, accelerations, job.batch_name);
}

/// Reports why a run failed, and what a resumed run would find.
ExitCode report_failure(const ScreeningJob& job, const RecordedEnd& end) {
  const std::string folder = job.results_path + ".parts";
  const std::string worlds = counted(end.total, "world");
  fail(ExitCode::some_failed, end.errors);
  if (end.parts_are_gone) {
    print_to(stderr, "{} is gone, and with it all worlds; the same command without --resume starts anew\n", folder);
  } else if (end.safe_worlds == 0) {
    print_to(stderr, "none of {} is safe; the same command without --resume starts anew\n", worlds);
  } else if (end.safe_worlds == end.total) {
    print_to(stderr, "all {} are in {}; --resume puts them together once the cause is gone\n", worlds, folder);
  } else {
    print_to(stderr, "{} of {} worlds are safe in {}; --resume continues from there\n", end.safe_worlds, end.total,
             folder);
  }
  return ExitCode::some_failed;
}

/// The steps after the results file is complete: export, table, exit code.
ExitCode conclude(const ScreeningJob& job, const RunDescription& description, const StageCosts& costs) {
  unwatch_stop_signals();  // all results are safe: a signal may end the rest at once
  if (job.costs_path) {
    if (const auto error = write_stage_seconds(costs.seconds(), *job.costs_path))
      return fail(ExitCode::some_failed, *error);
  }
  if (job.text_folder) {
    if (const auto error = export_text(job.results_path, *job.text_folder, job.batch_name))
      return fail(ExitCode::some_failed, *error);
  }
  std::vector<double> planned_ends;
  for (const Acceleration& acceleration : description.accelerations)
    planned_ends.push_back(planned_end(acceleration, job.settings));
  Result<ResultsReader> results = ResultsReader::open(job.results_path);
  if (!results) return fail(ExitCode::some_failed, results.error());
  const Result<OutcomeTable> table = outcome_table(*results, description.thresholds, planned_ends);
  if (!table) return fail(ExitCode::some_failed, table.error());
  if (!job.json && !job.quiet) {
    const Result<std::string> analyses = analysis_tables(*results);
    if (!analyses) return fail(ExitCode::some_failed, analyses.error());
    print_to(stdout, "{}{}\nresults: {}\n", table->text, *analyses, job.results_path);
  }
  return table->failed_worlds == 0 ? ExitCode::done : ExitCode::some_failed;
}

/// What is wrong with the job itself, before any input is read.
std::optional<Error> check_job(const ScreeningJob& job) {
  if (auto error = why_not_built(job.settings.screening.scheduler)) return error;
  std::error_code unknown;
  if (std::filesystem::is_directory(job.results_path, unknown))
    return Error{.file = job.results_path,
                 .what = "is a folder",
                 .accepted = "-o takes the name of a results file, such as results.h5"};
  if (job.text_folder && !job.record_series)
    return Error{.what = "text files need the series", .accepted = "leave out --no-series or --text"};
  if (job.part && job.text_folder)
    return Error{.what = "a shard writes no text files", .accepted = "leave out --text or --part"};
  if (job.part && job.settings.screening.first_failure)
    return Error{.what = "what FirstFailure leaves out depends on all layouts before, and a shard has not all",
                 .accepted = "leave out --first-failure or --part"};
  return std::nullopt;
}

/// `done` when the finished parts can be read: HDF5 may crash on damaged ones.
ExitCode check_parts_readable(const ScreeningJob& job, const RunDescription& description) {
  return guard_reading({.path = job.results_path, .cure = "--overwrite starts anew"}, [&] {
    const bool found = bool(find_finished(job.results_path, fingerprint(description)));
    return found ? ExitCode::done : ExitCode::some_failed;
  });
}

/// Simulates all layouts of a job.
ExitCode run_whole(const ScreeningJob& job, LayoutFiles& layouts, const Engine& engine,
                   const std::vector<ReadAcceleration>& accelerations, StageCosts& costs) {
  Recording recording{.path = job.results_path,
                      .description = describe_run(job, layouts, accelerations),
                      .existing = job.existing,
                      .report_finished = job.json};
  const RunDescription& description = recording.description;
  std::optional<Error> warning;
  const Result<OutputLock> lock = OutputLock::take(job.results_path, warning);
  if (!lock) return fail(ExitCode::bad_usage, lock.error());
  if (warning) warn(std::span(&*warning, 1));
  if (const auto error = check_side_files(job, description)) return fail(ExitCode::bad_usage, *error);
  if (job.existing == ExistingResults::resume) {
    const ExitCode readable = check_parts_readable(job, description);
    if (readable == ExitCode::bad_usage) return readable;
  }

  const StopSignal& stop = watch_stop_signals();
  Workers workers(job.settings.screening.scheduler, job.settings.screening.threads);
  TerminalObserver observer(job, description, stop);
  const RecordedEnd end = record_run(
      {engine, job.settings, workers, layouts, accelerations, job.record_series, methods_of(analyses_of(job.settings))},
      recording, *lock, observer, stop, costs);
  switch (end.kind) {
    case RecordedEnd::Kind::refused:
      return fail(ExitCode::bad_usage, end.errors);
    case RecordedEnd::Kind::failed:
      return report_failure(job, end);
    case RecordedEnd::Kind::stopped:
      print_to(stderr, "stopped after {} of {} worlds, kept in {}.parts; the same command with --resume continues\n",
               end.done, end.total, job.results_path);
      return exit_code_of(stop);
    case RecordedEnd::Kind::complete:
      break;
  }
  if (end.was_complete && !job.quiet) print_to(stderr, "{} is complete already\n", job.results_path);
  return conclude(job, description, costs);
}

}  // namespace

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

ExitCode run_screening(const ScreeningJob& asked) {
  if (const auto error = check_job(asked)) return fail(ExitCode::bad_usage, *error);
  const Result<std::unique_ptr<Engine>> engine = make_engine(asked.settings.screening.engine, asked.settings);
  if (!engine) return fail(ExitCode::bad_usage, engine.error());

  const std::vector<ReadAcceleration> accelerations = read_accelerations(asked, (*engine)->traits().steps_per_second);
  StageCosts costs;
  std::shared_ptr<LayoutFiles> layouts = asked.layouts;
  if (!layouts) {
    const StageTimer timer(costs, Stage::read);
    layouts = std::make_shared<LayoutFiles>(asked.layout_paths, asked.settings);
    warn(layouts->notes());
  }
  if (!asked.part) return run_whole(asked, *layouts, **engine, accelerations, costs);
  const DividedJob divided(asked, *layouts, accelerations, asked.part->parts);
  if (asked.part->part > divided.shards_with_layouts()) {
    print_to(stderr, "nothing to do: the run has {}, and this shard none of them\n",
             counted(divided.shards_with_layouts(), "block"));
    return ExitCode::done;
  }
  const Result<ScreeningJob> shard = divided.shard(asked.part->part);
  if (!shard) return fail(ExitCode::some_failed, shard.error());
  return run_whole(*shard, *shard->layouts, **engine, accelerations, costs);
}

}  // namespace holdfast::internal
