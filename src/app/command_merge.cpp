#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <system_error>
#include <vector>

#include "api/merged_run.hpp"
#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/reading_guard.hpp"
#include "app/report.hpp"
#include "app/screening.hpp"
#include "app/stop_signal.hpp"
#include "core/engine/run_observer.hpp"
#include "io/results/results_removal.hpp"
#include "parallel/schedulers/ticker.hpp"

namespace holdfast::internal {

namespace {

/// The files of shards that the user named, and those in folders; in increasing order.
Result<std::vector<std::string>> shard_paths(const MergeOptions& options) {
  std::vector<std::string> given = options.shards;
  if (given.empty()) given = {shards_folder(options.results_path)};
  std::vector<std::string> paths;
  for (const std::string& path : given) {
    std::error_code failure;
    if (!std::filesystem::is_directory(path, failure)) {
      if (!std::filesystem::exists(path, failure))
        return Error{.file = path, .what = "is not there", .accepted = "shards of `holdfast screen --part K/N`"};
      paths.push_back(path);
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(path, failure))
      if (entry.path().extension() == ".h5") paths.push_back(entry.path().string());
    if (failure) return Error{.file = path, .what = "cannot be read", .value = failure.message()};
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// Refuses an output that is one of the shards, by whatever path or link, and shards that are named like what a merge
/// makes and removes.
std::optional<Error> check_no_shard(const std::string& output, const std::vector<std::string>& shards) {
  std::error_code absent;
  for (const std::string& shard : shards) {
    const std::filesystem::path folder = std::filesystem::absolute(shard, absent).parent_path();
    if (std::filesystem::equivalent(output, shard, absent) ||
        std::filesystem::equivalent(output + ".tmp", shard, absent) ||
        std::filesystem::equivalent(output + ".parts", folder, absent))
      return Error{.file = output, .what = "is one of the shards", .value = shard, .accepted = "give another name"};
  }
  return std::nullopt;
}

/// `done` when HDF5 can open all shards. What is wrong with one otherwise is said with all that is wrong, by `gather`.
ExitCode check_readable(const std::vector<std::string>& paths, int memory) {
  for (const std::string& path : paths) {
    const auto open = [&] { return ShardFile::open(path) ? ExitCode::done : ExitCode::some_failed; };
    const GuardedFile shard = {.path = path, .cure = "simulate the shard again", .memory = memory};
    if (guard_reading(shard, open) == ExitCode::bad_usage) return ExitCode::bad_usage;
  }
  return ExitCode::done;
}

/// Shows how far a merge is on standard error, as a run of worlds does.
class MergeObserver final : public RunObserver {
 public:
  explicit MergeObserver(bool quiet) : quiet_(quiet) {}

  void started(const RunProgress& progress) override {
    progress_ = &progress;
    line_.emplace(progress, "worlds", stderr, quiet_);
    line_->show();
    ticker_ = std::make_unique<Ticker>(std::chrono::milliseconds(250), [this] { tick(); });
  }

  void ended() override {
    ticker_.reset();
    line_.reset();
    done_ = progress_->done;
  }

  /// Worlds in the file when the merge ended.
  std::uint64_t done() const { return done_; }

 private:
  void tick() {
    try {
      line_->show();
    } catch (const std::bad_alloc&) {
      // The next tick may find room.
    }
  }

  const bool quiet_;
  const RunProgress* progress_ = nullptr;
  std::uint64_t done_ = 0;
  std::optional<ProgressLine> line_;
  std::unique_ptr<Ticker> ticker_;
};

ExitCode merge(const MergeOptions& options, const std::vector<std::string>& paths) {
  const Result<RunOfShards> shards = RunOfShards::gather(paths);
  if (!shards) return fail(ExitCode::bad_usage, shards.errors());
  std::optional<Error> warning;
  const Result<OutputLock> lock = OutputLock::take(options.results_path, warning);
  if (!lock) return fail(ExitCode::bad_usage, lock.error());
  if (warning) warn(std::span(&*warning, 1));
  if (options.overwrite) {
    if (const auto error = remove_results(options.results_path)) return fail(ExitCode::bad_usage, *error);
  }
  const StopSignal& stop = watch_stop_signals();
  Workers workers(Scheduler::tbb, options.threads);
  MergeObserver observer(options.quiet);
  const auto error = merge_shards(*shards, options.results_path, *lock, workers, stop, observer);
  if (error) return fail(ExitCode::some_failed, *error);
  std::error_code unknown;
  if (!std::filesystem::exists(options.results_path, unknown)) {
    print_to(stderr, "stopped after {} of {} worlds; the same command continues\n", observer.done(),
             shards->world_count());
    return exit_code_of(stop);
  }
  if (!options.quiet)
    print_to(stdout, "results: {}, {} of {}\n", options.results_path, counted(shards->world_count(), "world"),
             counted(paths.size(), "shard"));
  return ExitCode::done;
}

}  // namespace

ExitCode run_merge_command(const MergeOptions& options) {
  if (options.results_path.empty())
    return fail(ExitCode::bad_usage, {.what = "an empty path", .accepted = "the name of a results file"});
  const Result<std::vector<std::string>> paths = shard_paths(options);
  if (!paths) return fail(ExitCode::bad_usage, paths.error());
  if (const auto error = check_no_shard(options.results_path, *paths)) return fail(ExitCode::bad_usage, *error);
  if (check_readable(*paths, options.memory) == ExitCode::bad_usage) return ExitCode::bad_usage;
  const GuardedFile shards = {.path = "a shard of " + options.results_path,
                              .cure = "simulate the one again that `holdfast summary --csv` cannot read",
                              .memory = options.memory,
                              .threads = thread_count(options.threads)};
  return guard_reading(shards, [&] { return merge(options, *paths); });
}

}  // namespace holdfast::internal
