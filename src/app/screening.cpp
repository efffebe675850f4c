#include "app/screening.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <string_view>
#include <unordered_map>

#include "app/crash_guard.hpp"
#include "app/engine_catalog.hpp"
#include "app/outcome_table.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/stage_costs.hpp"
#include "app/stop_signal.hpp"
#include "app/ticker.hpp"
#include "app/unit_runner.hpp"
#include "app/version.hpp"
#include "app/work_units.hpp"
#include "app/world_json.hpp"
#include "core/setting_table.hpp"
#include "core/simulate.hpp"
#include "io/acceleration_reader.hpp"
#include "io/output_lock.hpp"
#include "io/results_assembler.hpp"
#include "io/results_removal.hpp"
#include "io/results_writer.hpp"
#include "io/text_export.hpp"
#include "io/text_file.hpp"
#include "parallel/ordered_run.hpp"

namespace holdfast {

namespace {

constexpr std::size_t kWarningsShown = 20;

/// Most samples of a world: of 100 boxes they take 1.5 GB, all of which waits in memory for the world's end.
constexpr double kMostSamples = 200'000;

/// What a motion's series would be too long for, if they are.
std::optional<Error> check_samples(const ScreeningJob& job, const std::string& path, const Motion& motion) {
  const double samples = latest_end(motion, job.settings) / job.settings.results_interval;
  if (!job.record_series || samples <= kMostSamples) return std::nullopt;
  return Error{
      .file = path,
      .what = "would give a world too many samples",
      .value = fmt::format("{:.0f}", samples),
      .accepted = fmt::format("at most {:.0f}: a longer ResultsIntervallInSeconds, or --no-series", kMostSamples)};
}

/// What results call an input.
std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// Says so where inputs share a file name, by which alone results tell them apart.
void warn_of_same_names(const std::vector<std::string>& paths) {
  std::unordered_map<std::string, std::string_view> first;
  std::optional<Error> warning;
  std::size_t count = 0;
  for (const std::string& path : paths) {
    const auto [same, is_new] = first.emplace(file_name(path), path);
    if (is_new || ++count > 1) continue;
    warning = Error{
        .file = path, .what = "has the same name in the results as", .value = printable(std::string(same->second))};
  }
  if (count > 1) warning->accepted = fmt::format("one of {} such files", count);
  if (warning) warn(std::span(&*warning, 1));
}

std::vector<RunMotion> read_motions(const ScreeningJob& job) {
  std::vector<RunMotion> motions;
  for (const std::string& path : job.acceleration_paths) {
    RunMotion& entry = motions.emplace_back();
    entry.motion.name = file_name(path);
    const Result<TextFile> file = read_text_file(path);
    std::vector<Error> warnings;
    Result<Motion> motion = file ? parse_acceleration(*file, warnings) : Result<Motion>(file.errors());
    if (file) entry.motion.sha256 = file->sha256;
    if (motion) {
      if (const auto error = check_samples(job, path, *motion)) motion = *error;
    }
    if (motion) {
      entry.motion = std::move(*motion);
    } else {
      entry.error = motion.error().message();
      for (const Error& error : motion.errors()) print_to(stderr, "{}\n", error.message());
    }
  }
  return motions;
}

/// "1 layout", "2 layouts".
std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string host_name() {
  std::array<char, 256> name = {};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// The engine's name, and its accuracy where it has one.
std::string engine_text(const Settings& settings) {
  const std::string& engine = settings.screening.engine;
  return engine == "native" ? engine + ", accuracy " + find_setting("Native", "Accuracy")->get(settings, 0) : engine;
}

RunDescription describe_run(const ScreeningJob& job, const std::vector<RunMotion>& motions) {
  RunDescription run;
  run.software = fmt::format("holdfast {}", kVersion);
  run.git_commit = kGitCommit;
  run.engine = job.settings.screening.engine;
  run.command_line = job.command_line;
  run.created_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  run.host = host_name();
  run.config_text = job.config_text;
  run.settings = effective_settings(job.settings);
  for (const std::string& path : job.layout_paths) run.layout_names.push_back(file_name(path));
  for (const RunMotion& motion : motions) run.accelerations.push_back(motion.motion);
  run.record_series = job.record_series;
  run.thresholds = recording_plan(job.settings, true).thresholds;
  return run;
}

/// What is finished must be the first worlds of this job, up to the border of a unit of work, and their layouts must be
/// what they were.
std::optional<Error> check_continues(const Progress& finished, const ScreeningJob& job, const EngineTraits& traits) {
  const std::vector<std::string>& layout_paths = job.layout_paths;
  const std::size_t motions = job.acceleration_paths.size();
  const std::size_t total = layout_paths.size() * motions;
  const std::size_t world = finished.world_count;
  const WorkUnits units(layout_paths.size(), motions, traits);
  if (world > total || finished.layouts.size() != (world + motions - 1) / motions ||
      (world < total && units.first_world(units.beginning_with(world)) != world)) {
    return Error{
        .file = job.results_path,
        .what = "cannot be gone on with: what is finished does not end where a unit of work of this engine does",
        .value = std::to_string(world) + " of " + std::to_string(total) + " worlds",
        .accepted = "--overwrite starts anew"};
  }
  for (std::size_t i = 0; i < finished.layouts.size(); ++i) {
    const Result<TextFile> file = read_text_file(layout_paths[i]);
    const std::string sha256 = file ? file->sha256 : "";
    if (sha256 == finished.layouts[i].second) continue;
    return Error{.file = layout_paths[i],
                 .what = "this layout has changed since the run that is to be resumed",
                 .accepted = "put the old file back, or start anew with --overwrite"};
  }
  return std::nullopt;
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

/// One run from the first unit to the last: what its threads share.
class Run {
 public:
  Run(const ScreeningJob& job, const Engine& engine, const std::vector<RunMotion>& motions, ResultsWriter& writer,
      const Progress& finished, StageCosts& costs)
      : job_(job),
        engine_(engine),
        motions_(motions),
        writer_(writer),
        costs_(costs),
        world_(finished.world_count),
        thresholds_(recording_plan(job.settings, true).thresholds) {
    counts_.total = job.layout_paths.size() * motions.size();
    counts_.resumed = finished.world_count;
    counts_.done = finished.world_count;
  }

  /// False when it was stopped or writing failed: then the results are not all there.
  bool go() {
    const WorkUnits units(job_.layout_paths.size(), motions_.size(), engine_.traits());
    UnitRunner runner(engine_, job_.settings, job_.record_series, job_.layout_paths, motions_, stop_.drop, costs_);
    const std::size_t first = units.beginning_with(world_);
    {
      ProgressLine line(counts_, stderr, job_.quiet);
      const Ticker ticker(std::chrono::milliseconds(250), [&] { tick(line); });
      run_in_order(
          *scheduler_of(job_.settings.screening.scheduler), thread_count(job_.settings.screening.threads),
          units.count() - first,
          [&](std::size_t i) {
            if (stop_.no_more || failed_) return std::optional<UnitRecord>();
            return runner.run(units[first + i], units.sharing_layouts(first + i, first));
          },
          [&](UnitRecord&& record) {
            announce(record);
            const StageTimer timer(costs_, Stage::write);
            return writer_.place(std::move(record));
          },
          [&](PlacedUnit&& unit) {
            const StageTimer timer(costs_, Stage::compress);
            return ResultsWriter::pack(std::move(unit));
          },
          [&](PackedUnit&& unit) { return write(std::move(unit)); });
      keep(writer_.finish());
    }
    if (warning_count_ > kWarningsShown)
      print_to(stderr, "and {} more warnings; `holdfast check` prints all\n", warning_count_ - kWarningsShown);
    if (error_) print_to(stderr, "{}\n", error_->message());
    return !error_ && counts_.done == counts_.total;
  }

  bool write_failed() const { return error_.has_value(); }
  std::uint64_t done() const { return counts_.done; }
  std::uint64_t total() const { return counts_.total; }

 private:
  /// Says what became of a unit's worlds, in their order.
  void announce(const UnitRecord& record) {
    const std::scoped_lock lock(notes_mutex_);
    for (const Error& warning : record.warnings)
      if (!job_.quiet && ++warning_count_ <= kWarningsShown) notes_.push_back("warning: " + warning.message());
    for (const WorldRecord& world : record.worlds) {
      const std::string layout = file_name(job_.layout_paths[world.layout]);
      const std::string& acceleration = motions_[world.acceleration].motion.name;
      if (job_.json) lines_ += world_json(world, layout, acceleration, world_, thresholds_) + "\n";
      if (has(world.outcome.status, Status::bad_layout) && world.acceleration == 0) notes_.push_back(world.status_text);
      if (has(world.outcome.status, Status::non_finite))
        notes_.push_back(printable(fmt::format("{} under {}: {}", layout, acceleration, world.status_text)));
      ++world_;
    }
  }

  bool write(PackedUnit&& unit) {
    std::uint64_t steps = 0;
    std::uint64_t skipped = 0;
    for (const WorldRecord& world : unit.record.worlds) {
      steps += world.outcome.counters.steps;
      skipped += world.outcome.counters.steps_skipped;
    }
    const std::uint64_t worlds = unit.record.worlds.size();
    {
      const StageTimer timer(costs_, Stage::write);
      if (!keep(writer_.write(std::move(unit)))) return false;
    }
    counts_.steps += steps;
    counts_.steps_skipped += skipped;
    counts_.done += worlds;
    print_lines();
    return true;
  }

  /// Keeps the first error, from whichever thread. True when there is none.
  bool keep(std::optional<Error> error) {
    const std::scoped_lock lock(notes_mutex_);
    if (error && !error_) error_ = std::move(error);
    if (error_) failed_ = true;
    return !error_;
  }

  /// Not under the lock: a reader that pauses must not keep the open part from being closed in time.
  void print_lines() {
    std::string lines;
    {
      const std::scoped_lock lock(notes_mutex_);
      lines.swap(lines_);
    }
    write_unless(stop_.drop, stdout, lines);
  }

  /// Four times a second: the open part may be due though no world has finished; news for the user.
  void tick(ProgressLine& line) {
    keep(writer_.close_part_if_due(std::chrono::steady_clock::now()));
    std::vector<std::string> notes;
    {
      const std::scoped_lock lock(notes_mutex_);
      notes.swap(notes_);
    }
    for (const std::string& note : notes) line.note(note);
    if (stop_.no_more && !stop_told_) {
      line.note(stop_.drop ? "stopping" : "stopping: finishing the worlds in flight; press Ctrl-C again to drop them");
      stop_told_ = true;
    }
    line.show();
  }

  const ScreeningJob& job_;
  const Engine& engine_;
  const std::vector<RunMotion>& motions_;
  ResultsWriter& writer_;
  StageCosts& costs_;
  const StopRequest& stop_ = watch_stop_signals();
  ProgressCounts counts_;
  std::size_t world_;  ///< index of the next world to be placed
  Thresholds thresholds_;
  std::mutex notes_mutex_;
  std::size_t warning_count_ = 0;
  std::vector<std::string> notes_;  ///< lines that the progress line's thread will print
  std::string lines_;               ///< JSON of worlds placed and not yet told
  std::optional<Error> error_;
  std::atomic<bool> failed_ = false;
  bool stop_told_ = false;
};

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
  for (const Motion& motion : description.accelerations) accelerations.push_back(motion.name);
  return prepare_text_export(*job.text_folder, description.layout_names, accelerations, job.batch_name);
}

/// How a run ends that a signal stopped: what finished is kept.
ExitCode stopped(const ScreeningJob& job, std::uint64_t done, std::uint64_t total) {
  print_to(stderr, "stopped after {} of {} worlds, kept in {}.parts; the same command with --resume goes on\n", done,
           total, job.results_path);
  return exit_code_of(watch_stop_signals());
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
      print_to(stderr, "all {} are safe in {}.parts; --resume puts them together\n", counted(total, "world"),
               job.results_path);
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
  if (job.text_folder && !job.record_series)
    return fail(ExitCode::bad_usage,
                {.what = "text files need the series", .accepted = "leave out --no-series or --text"});

  const std::vector<RunMotion> motions = read_motions(job);
  const RunDescription description = describe_run(job, motions);
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
    const ExitCode readable =
        guard_reading(job.results_path, [&] { return look() ? ExitCode::done : ExitCode::some_failed; });
    if (readable == ExitCode::bad_usage) return readable;
    const Result<Progress> found = look();
    if (!found) return fail(ExitCode::bad_usage, found.error());
    finished = *found;
    if (const auto error = check_continues(finished, job, (*engine)->traits()))
      return fail(ExitCode::bad_usage, *error);
    if (job.json) {
      if (const auto error = print_finished(job, description, finished)) return fail(ExitCode::bad_usage, *error);
    }
    if (finished.world_count == 0 && !job.quiet)
      print_to(stderr, "{}: nothing is finished that could be resumed, all worlds are to be run\n", job.results_path);
    if (finished.complete) {
      if (!job.quiet) print_to(stderr, "{} is complete already\n", job.results_path);
      StageCosts none;
      return conclude(job, description, true, none);
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
             counted(motions.size(), "acceleration"), counted(job.layout_paths.size() * motions.size(), "world"),
             engine_text(job.settings), job.settings.screening.scheduler, counted(threads, "thread"),
             finished.world_count > 0 ? fmt::format(", {} finished before", finished.world_count) : "");
  }
  StageCosts costs;
  Run run(job, **engine, motions, **writer, finished, costs);
  const bool all_there = run.go();
  if (run.write_failed()) {
    // What was written to the part that failed is lost: only the finished parts count.
    const Result<Progress> safe = find_finished(job.results_path, fingerprint(description));
    print_to(stderr, "{} of {} worlds are safe in {}.parts; --resume goes on from there\n",
             safe ? safe->world_count : 0, run.total(), job.results_path);
    return ExitCode::some_failed;
  }
  if (!all_there) return stopped(job, run.done(), run.total());
  return conclude(job, description, false, costs);
}

}  // namespace holdfast
