#include "api/merged_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

#include "io/results/results_assembler.hpp"
#include "io/results/results_resume.hpp"
#include "io/results/results_writer.hpp"
#include "parallel/schedulers/ordered_run.hpp"

namespace holdfast::internal {

namespace {

/// An error that says how a shard differs from the first one, if it is of another run.
std::optional<Error> other_run(const ShardFile& shard, const ShardFile& first) {
  const std::string difference = fingerprint_difference(shard.shard().run_fingerprint, first.shard().run_fingerprint);
  if (!difference.empty())
    return Error{.file = shard.path(),
                 .what = "is a shard of a run with other " + difference,
                 .accepted = "shards of one run, as " + first.path()};
  const Shard& a = shard.shard().shard;
  const Shard& b = first.shard().shard;
  if (a.parts == b.parts && a.block == b.block && a.layouts == b.layouts) return std::nullopt;
  return Error{.file = shard.path(),
               .what = "is a shard of another division",
               .value = fmt::format("{} of {}", a.part, a.parts),
               .accepted = fmt::format("shards of {}, as {}", b.parts, first.path())};
}

/// Names at most a few of many numbers.
std::string some_of(const std::vector<std::uint64_t>& numbers) {
  constexpr std::size_t kMost = 10;
  const std::size_t shown = std::min(numbers.size(), kMost);
  const std::string text =
      fmt::format("{}", fmt::join(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return shown < numbers.size() ? fmt::format("{} and {} more", text, numbers.size() - shown) : text;
}

std::uint64_t part_of(const ShardFile& file) { return file.shard().shard.part; }

/// @param found by their part, as in the next one
void name_double(const std::vector<ShardFile>& found, std::vector<Error>& errors) {
  for (std::size_t i = 1; i < found.size(); ++i) {
    if (part_of(found[i]) != part_of(found[i - 1])) continue;
    errors.push_back({.file = found[i].path(),
                      .what = "is the same shard as " + found[i - 1].path(),
                      .value = fmt::format("{} of {}", part_of(found[i]), found[i].shard().shard.parts),
                      .accepted = "each shard once"});
  }
}

/// Shards without layouts, of a run with few blocks, need not be there.
void name_missing(const std::vector<ShardFile>& found, std::vector<Error>& errors) {
  const Shard& shard = found.front().shard().shard;
  std::vector<std::uint64_t> missing;
  auto next = found.begin();
  for (std::uint64_t part = 1; part <= std::min(shard.parts, shard.block_count()); ++part) {
    while (next != found.end() && part_of(*next) < part) ++next;
    if (next == found.end() || part_of(*next) > part) missing.push_back(part);
  }
  if (missing.empty()) return;
  errors.push_back(
      {.what = missing.size() == 1 ? "a shard is missing" : fmt::format("{} shards are missing", missing.size()),
       .value = fmt::format("{} of {}", some_of(missing), shard.parts),
       .accepted = "their commands make them; those that were stopped go on with --resume"});
}

/// The run of all shards as if it had been one.
RunDescription whole_run(const std::vector<ShardFile>& shards) {
  const Shard& shard = shards.front().shard().shard;
  RunDescription whole = shards.front().run();
  whole.shard.reset();
  whole.layout_names.clear();
  whole.layout_hashes.clear();
  for (std::uint64_t layout = 0; layout < shard.layouts; ++layout) {
    const std::uint64_t block = layout / shard.block;
    const RunDescription& run = shards[block % shard.parts].run();
    const std::uint64_t local = block / shard.parts * shard.block + layout % shard.block;
    whole.layout_names.push_back(run.layout_names.at(local));
    whole.layout_hashes.push_back(run.layout_hashes.at(local));
  }
  return whole;
}

}  // namespace

Result<RunOfShards> RunOfShards::gather(const std::vector<std::string>& paths) {
  std::vector<Error> errors;
  std::vector<ShardFile> found;
  for (const std::string& path : paths) {
    Result<ShardFile> shard = ShardFile::open(path);
    if (!shard) {
      errors.push_back(shard.error());
      continue;
    }
    if (!found.empty()) {
      if (const auto other = other_run(*shard, found.front())) {
        errors.push_back(*other);
        continue;
      }
    }
    found.push_back(std::move(*shard));
  }
  if (found.empty()) {
    if (errors.empty())
      errors.push_back({.what = "there are no shards", .accepted = "files of `holdfast screen --part K/N`"});
    return errors;
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const ShardFile& a, const ShardFile& b) { return part_of(a) < part_of(b); });
  name_double(found, errors);
  // A shard that could not be used is not missing, too.
  if (errors.empty()) name_missing(found, errors);
  if (!errors.empty()) return errors;

  RunOfShards all;
  all.run_ = whole_run(found);
  // A layout that changed while the run read it is a bad one, and has other contents here: what is of these is left
  // out.
  if (const std::string expected = found.front().shard().run_fingerprint; !expected.starts_with(fingerprint(all.run_)))
    return Error{.file = found.front().path(),
                 .what = "does not fit the other shards",
                 .value = fingerprint_difference(fingerprint(all.run_), expected),
                 .accepted = "shards of one run, by this version of holdfast"};
  all.shards_ = std::move(found);
  return all;
}

Result<std::uint64_t> RunOfShards::block_after(std::uint64_t worlds) const {
  if (worlds == world_count()) return block_count();
  if (worlds % block_worlds() == 0) return worlds / block_worlds();
  return Error{.what = "cannot go on after worlds that do not end with a block of the shards",
               .value = fmt::format("{} of {} worlds", worlds, world_count()),
               .accepted = "--overwrite starts anew"};
}

Result<ColumnSet> RunOfShards::read(std::uint64_t block, const AxisCounts& placed) const {
  const ShardFile& file = shards_[block % shards_.front().shard().shard.parts];
  const Shard& shard = file.shard().shard;
  const std::uint64_t begin = block / shard.parts * shard.block;
  const std::uint64_t count = std::min(shard.block, shard.layouts - block * shard.block);
  return file.read(begin, begin + count, placed);
}

std::optional<Error> merge_shards(const RunOfShards& shards, const std::string& results_path,
                                  const OutputLock& /*lock*/, Workers& workers, const StopRequest& stop,
                                  RunObserver& observer) {
  using Placed = std::unique_ptr<SinkUnit>;
  const Result<Progress> finished = find_finished(results_path, fingerprint(shards.run()));
  if (!finished) return finished.error();
  if (finished->complete) return std::nullopt;
  if (finished->part_count > 0 && finished->layout_hashes != shards.run().layout_hashes)
    return Error{.file = results_path,
                 .what = "cannot go on: the shards have layouts with other contents than when the merge began",
                 .accepted = "--overwrite starts anew"};
  const Result<std::uint64_t> first_block = shards.block_after(finished->world_count);
  if (!first_block) return first_block.error();
  std::optional<Error> failure;
  {
    const Result<std::unique_ptr<ResultsWriter>> writer = ResultsWriter::open(results_path, shards.run(), *finished);
    if (!writer) return writer.error();
    std::mutex hdf5;  // which one thread at a time may call; reading and writing are stages of their own
    std::uint64_t done = *first_block;
    RunProgress progress{
        .total = shards.world_count(), .resumed = finished->world_count, .done = finished->world_count};
    observer.started(progress);
    const auto read = [&](std::uint64_t&& block) -> Placed {
      const std::lock_guard lock(hdf5);
      if (failure) return nullptr;
      Result<ColumnSet> columns = shards.read(block, (*writer)->placed());
      if (!columns) {
        failure = columns.error();
        return nullptr;
      }
      return (*writer)->place(std::move(*columns));
    };
    const auto pack = [](Placed&& unit) -> Placed {
      if (unit) unit->pack();
      return std::move(unit);
    };
    const auto write = [&](Placed&& unit) {
      const std::lock_guard lock(hdf5);
      if (!unit || failure) return false;
      failure = unit->write();
      if (failure) return false;
      progress.done = shards.worlds_of(++done);
      return true;
    };
    const auto next = [&](std::size_t block) -> std::optional<std::uint64_t> {
      return stop.no_more ? std::nullopt : std::optional<std::uint64_t>(*first_block + block);
    };
    run_in_order(workers, shards.block_count() - *first_block, next, read, pack, write);
    if (!failure) failure = (*writer)->finish();
    observer.ended();
    if (failure || done < shards.block_count()) return failure;
  }
  auto error = assemble(results_path, shards.run(), &stop.no_more);
  return stop.no_more ? std::nullopt : error;
}

}  // namespace holdfast::internal
