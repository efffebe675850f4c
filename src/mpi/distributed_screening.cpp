#include "mpi/distributed_screening.hpp"

#include <mpi.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "app/commands.hpp"
#include "app/report.hpp"
#include "app/run_inputs.hpp"
#include "app/shard_job.hpp"
#include "io/results/shard_file.hpp"
#include "mpi/shared_counter.hpp"

namespace holdfast::internal {

namespace {

/// The worst exit code of all ranks, on all ranks.
ExitCode worst(ExitCode own) {
  int code = static_cast<int>(own);
  MPI_Allreduce(MPI_IN_PLACE, &code, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return static_cast<ExitCode>(code);
}

/// Whether it is so on all ranks; on all ranks.
bool on_all(bool own) {
  int all = own ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_LAND, MPI_COMM_WORLD);
  return all != 0;
}

/// What rank 0 finds before anything is simulated. The ranks do not lock the results file together, but each its shard.
std::optional<Error> prepare(const ScreeningJob& job) {
  const std::string folder = shards_folder(job.results_path);
  std::error_code failure;
  const auto is_there = [&](const std::string& path) { return std::filesystem::exists(path, failure); };
  switch (job.existing) {
    case ExistingResults::refuse:
      if (is_there(job.results_path))
        return Error{.file = job.results_path,
                     .what = "exists already, and a finished results file is never overwritten",
                     .accepted = "give another name, or --overwrite to replace it"};
      if (is_there(folder))
        return Error{.file = folder,
                     .what = "contains shards of an interrupted run",
                     .accepted = "--resume continues it, --overwrite starts anew"};
      break;
    case ExistingResults::overwrite:
      std::filesystem::remove_all(folder, failure);
      if (failure) return Error{.file = folder, .what = "cannot be removed", .value = failure.message()};
      break;
    case ExistingResults::resume:
      break;
  }
  return std::nullopt;
}

struct ShardsEnd {
  ExitCode code = ExitCode::done;  ///< the worst of them
  bool finished = true;            ///< whether all were, also where worlds failed
};

/// Simulates shards until there are no more, or one cannot be finished: then others would fare no better.
ShardsEnd run_shards(const ScreeningJob& job, SharedCounter& counter) {
  ScreeningJob of_shards = job;
  of_shards.quiet = true;
  of_shards.existing = ExistingResults::resume;
  const LayoutFiles layouts(job.layout_paths, job.settings);
  const DividedJob divided(of_shards, layouts, read_accelerations(job, 0.0), kMostShards);
  const std::uint64_t count = divided.shards_with_layouts();
  ShardsEnd end;
  for (std::uint64_t next = counter.add(1); next < count && end.finished; next = counter.add(1)) {
    if (!job.quiet && SharedCounter::rank() == 0) print_to(stderr, "shard {} of {}\n", next + 1, count);
    const Result<ScreeningJob> shard = divided.shard(next + 1);
    const ExitCode ended = shard ? run_screening(*shard) : fail(ExitCode::bad_usage, shard.error());
    end.code = std::max(end.code, ended);
    // Without a file where it could not be written, as on a full disk.
    std::error_code unknown;
    end.finished = (ended == ExitCode::done || ended == ExitCode::some_failed) &&
                   std::filesystem::exists(shard->results_path, unknown);
    if (!end.finished) counter.add(count);  // no rank takes another
  }
  return end;
}

/// Merges the shards and removes them.
ExitCode merge(const ScreeningJob& job) {
  const bool overwrite = job.existing == ExistingResults::overwrite;
  const ExitCode code =
      run_merge_command({.results_path = job.results_path, .overwrite = overwrite, .quiet = job.quiet});
  std::error_code ignored;
  if (code == ExitCode::done) std::filesystem::remove_all(shards_folder(job.results_path), ignored);
  return code;
}

}  // namespace

ExitCode run_distributed(const ScreeningJob& job) {
  const bool first = SharedCounter::rank() == 0;
  SharedCounter counter;
  ExitCode code = ExitCode::done;
  if (first) {
    if (job.part) {
      code =
          fail(ExitCode::bad_usage, {.what = "ranks share the shards out themselves", .accepted = "leave out --part"});
    } else if (const auto error = prepare(job)) {
      code = fail(ExitCode::bad_usage, *error);
    }
  }
  code = worst(code);
  if (code != ExitCode::done) return code;
  const ShardsEnd end = run_shards(job, counter);
  code = worst(end.code);
  if (!on_all(end.finished)) {
    if (first && code != ExitCode::bad_usage)
      print_to(stderr, "shards that are finished are in {}; the same command with --resume continues\n",
               shards_folder(job.results_path));
    return code;
  }
  return worst(std::max(code, first ? merge(job) : ExitCode::done));
}

}  // namespace holdfast::internal
