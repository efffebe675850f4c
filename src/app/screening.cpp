#include "app/screening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "app/crash_guard.hpp"
#include "app/engine_catalog.hpp"
#include "app/layout_shelf.hpp"
#include "app/outcome_table.hpp"
#include "app/report.hpp"
#include "app/run_inputs.hpp"
#include "app/screening/stage_costs.hpp"
#include "app/screening/work_units.hpp"
#include "app/stop_signal.hpp"
#include "app/world_json.hpp"
#include "app/world_run.hpp"
#include "core/model/setting_table.hpp"
#include "io/export/text_export.hpp"
#include "io/input/text_file.hpp"
#include "io/results/output_lock.hpp"
#include "io/results/results_assembler.hpp"
#include "io/results/results_removal.hpp"
#include "io/results/results_writer.hpp"
#include "parallel/schedulers/scheduler.hpp"

namespace holdfast {

namespace {

/// "1 layout", "2 layouts".
std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// The engine's name, and its accuracy where it has one.
std::string engine_text(const Settings& settings) {
  const std::string& engine = settings.screening.engine;
  return engine == "native" ? engine + ", accuracy " + find_setting("Native", "Accuracy")->get(settings, 0) : engine;
}

/// What is finished must be the first worlds of this job, up to the border of a unit of work, and all layouts must be
/// what they were when the run began.
std::optional<Error> check_continues(const Progress& finished, const ScreeningJob& job,
                                     const std::vector<std::string>& layout_hashes, const EngineTraits& traits) {
  if (finished.part_count == 0 && !finished.complete) return std::nullopt;
  const std::vector<std::string>& layout_paths = job.layout_paths;
  const std::size_t accelerations = job.acceleration_paths.size();
  const std::size_t total = layout_paths.size() * accelerations;
  const std::size_t world = finished.world_count;
  const WorkUnits units(layout_paths.size(), accelerations, traits);
  if (world > total || finished.layout_count != (world + accelerations - 1) / accelerations ||
      finished.layout_hashes.size() != layout_paths.size() ||
      (world < total && units.first_world(units.beginning_with(world)) != world)) {
    return Error{
        .file = job.results_path,
        .what = "cannot be gone on with: what is finished does not end where a unit of work of this engine does",
        .value = std::to_string(world) + " of " + std::to_string(total) + " worlds",
        .accepted = "--overwrite starts anew"};
  }
  const auto [then, now] =
      std::mismatch(finished.layout_hashes.begin(), finished.layout_hashes.end(), layout_hashes.begin());
  if (now == layout_hashes.end()) return std::nullopt;
  return Error{.file = layout_paths[static_cast<std::size_t>(now - layout_hashes.begin())],
               .what = "this layout has changed since the run that is to be resumed",
               .accepted = "put the old file back, or start anew with --overwrite"};
}

/// Tells of the worlds that an earlier run finished as it told of them then.
std::optional<Error> print_finished(const ScreeningJob& job, const RunDescription& description,
                                    const Progress& finished) {
  std::size_t index = 0;
  return visit_finished(job.results_path, finished, [&](const WorldRecord& world) {
    // Names come from this run's inputs; a world that has none there is of a damaged file.
    if (world.layout >= description.layout_names.size() || world.acceleration >= description.accelerations.size())
      return;
    print_to(stdout, "{}\n",
             world_json(world, description.layout_names[world.layout],
                        description.accelerations[world.acceleration].name, index++, description.thresholds));
  });
}

/// The full path of a file that need not be there, without links.
std::filesystem::path place_of(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path, unknown), unknown);
}

/// What keeps the files beside the results from being written, so that it is told before the run.
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

/// How a run ends that a signal stopped: what finished is kept.
ExitCode stopped(const ScreeningJob& job, std::uint64_t done, std::uint64_t total) {
  print_to(stderr, "stopped after {} of {} worlds, kept in {}.parts; the same command with --resume goes on\n", done,
           total, job.results_path);
  return exit_code_of(watch_stop_signals());
}

/// Says after a failure what a resumed run would find. What was written to the part that failed is lost: only the
/// finished parts count.
void tell_what_is_safe(const ScreeningJob& job, const RunDescription& description, std::size_t total) {
  const std::string folder = job.results_path + ".parts";
  const Result<Progress> safe = find_finished(job.results_path, fingerprint(description));
  std::error_code unknown;
  if (!std::filesystem::exists(folder, unknown)) {
    print_to(stderr, "{} is gone, and with it all worlds; the same command without --resume starts anew\n", folder);
  } else if (!safe) {
    print_to(stderr, "{}\n", safe.error().message());
  } else if (safe->world_count == 0) {
    print_to(stderr, "none of {} is safe; the same command without --resume starts anew\n", counted(total, "world"));
  } else if (safe->world_count == total) {
    print_to(stderr, "all {} are in {}; --resume puts them together once the cause is gone\n", counted(total, "world"),
             folder);
  } else {
    print_to(stderr, "{} of {} worlds are safe in {}; --resume goes on from there\n", safe->world_count, total, folder);
  }
}

/// What is left to do when all worlds are in parts or in the results file: assemble, export, show, judge.
ExitCode conclude(const ScreeningJob& job, const RunDescription& description, bool assembled, StageCosts& costs) {
  if (!assembled) {
    const std::atomic<bool>& stop = watch_stop_signals().no_more;
    const auto error = [&] {
      const StageTimer timer(costs, Stage::assemble);
      return assemble(job.results_path, description, &stop);
    }();
    const std::size_t total = job.layout_paths.size() * description.accelerations.size();
    if (error && stop) return stopped(job, total, total);
    if (error) {
      fail(ExitCode::some_failed, *error);
      tell_what_is_safe(job, description, total);
      return ExitCode::some_failed;
    }
  }
  unwatch_stop_signals();  // all is safe: what is left may end at once
  if (job.costs_path) {
    if (const auto error = write_stage_seconds(costs.seconds(), *job.costs_path))
      return fail(ExitCode::some_failed, *error);
  }
  if (job.text_folder) {
    if (const auto error = export_text(job.results_path, *job.text_folder, job.batch_name))
      return fail(ExitCode::some_failed, *error);
  }
  const auto table = outcome_table(job.results_path, description.thresholds);
  if (!table) return fail(ExitCode::some_failed, table.error());
  if (!job.json && !job.quiet) print_to(stdout, "{}\nresults: {}\n", table->text, job.results_path);
  return table->failed_worlds == 0 ? ExitCode::done : ExitCode::some_failed;
}

}  // namespace

ExitCode run_screening(const ScreeningJob& job) {
  if (!scheduler_of(job.settings.screening.scheduler)) {
    return fail(ExitCode::bad_usage, {.what = "unknown scheduler",
                                      .value = job.settings.screening.scheduler,
                                      .accepted = fmt::format("accepted are {}", fmt::join(scheduler_names(), ", "))});
  }
  const Result<std::unique_ptr<Engine>> engine = make_engine(job.settings.screening.engine, job.settings);
  if (!engine) return fail(ExitCode::bad_usage, engine.error());
  std::error_code unknown;
  if (std::filesystem::is_directory(job.results_path, unknown))
    return fail(ExitCode::bad_usage, {.file = job.results_path,
                                      .what = "is a folder",
                                      .accepted = "-o takes the name of a results file, such as results.h5"});
  if (job.text_folder && !job.record_series)
    return fail(ExitCode::bad_usage,
                {.what = "text files need the series", .accepted = "leave out --no-series or --text"});

  const std::vector<RunAcceleration> accelerations = read_accelerations(job);
  StageCosts costs;
  const RunDescription description = describe_run(job, accelerations, [&] {
    const StageTimer timer(costs, Stage::read);
    return hash_layouts(job.layout_paths);
  }());
  std::optional<Error> warning;
  const Result<OutputLock> lock = OutputLock::take(job.results_path, warning);
  if (!lock) return fail(ExitCode::bad_usage, lock.error());
  if (warning) warn(std::span(&*warning, 1));
  if (const auto error = check_side_files(job, description)) return fail(ExitCode::bad_usage, *error);
  if (job.overwrite) {
    if (const auto error = remove_results(job.results_path)) return fail(ExitCode::bad_usage, *error);
  }
  Progress finished;
  if (job.resume) {
    const auto look = [&] { return find_finished(job.results_path, fingerprint(description)); };
    const ExitCode readable = guard_reading(
        job.results_path, [&] { return look() ? ExitCode::done : ExitCode::some_failed; }, "--overwrite starts anew");
    if (readable == ExitCode::bad_usage) return readable;
    const Result<Progress> found = look();
    if (!found) return fail(ExitCode::bad_usage, found.error());
    finished = *found;
    if (const auto error = check_continues(finished, job, description.layout_hashes, (*engine)->traits()))
      return fail(ExitCode::bad_usage, *error);
    if (job.json) {
      if (const auto error = print_finished(job, description, finished)) return fail(ExitCode::bad_usage, *error);
    }
    if (finished.world_count == 0 && !job.quiet)
      print_to(stderr, "{}: nothing is finished that could be resumed, all worlds are to be run\n", job.results_path);
    if (finished.complete) {
      if (!job.quiet) print_to(stderr, "{} is complete already\n", job.results_path);
      return conclude(job, description, true, costs);
    }
  }
  Result<std::unique_ptr<ResultsWriter>> writer = ResultsWriter::open(job.results_path, description, finished);
  if (!writer) return fail(ExitCode::bad_usage, writer.error());

  watch_stop_signals();
  if (!job.quiet) {
    warn_of_same_names(job.layout_paths);
    warn_of_same_names(job.acceleration_paths);
    const auto threads = static_cast<std::size_t>(thread_count(job.settings.screening.threads));
    print_to(stderr, "{} x {} = {}, engine {}, scheduler {}, {}{}\n", counted(job.layout_paths.size(), "layout"),
             counted(accelerations.size(), "acceleration"),
             counted(job.layout_paths.size() * accelerations.size(), "world"), engine_text(job.settings),
             job.settings.screening.scheduler, counted(threads, "thread"),
             finished.world_count > 0 ? fmt::format(", {} finished before", finished.world_count) : "");
  }
  WorldRun run(job, **engine, description.layout_hashes, accelerations, **writer, finished, costs);
  const bool all_there = run.go();
  if (run.write_failed()) {
    tell_what_is_safe(job, description, run.total());
    return ExitCode::some_failed;
  }
  if (!all_there) return stopped(job, run.done(), run.total());
  return conclude(job, description, false, costs);
}

}  // namespace holdfast
