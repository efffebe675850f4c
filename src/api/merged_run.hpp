#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/run_observer.hpp"
#include "io/results/output_lock.hpp"
#include "io/results/shard_file.hpp"
#include "parallel/schedulers/workers.hpp"

namespace holdfast::internal {

/// The shards of one run, all of them.
class RunOfShards {
 public:
  /// Errors name shards that are missing, there twice, not finished, damaged, or of another run.
  /// @param paths files of shards, in any order
  static Result<RunOfShards> gather(const std::vector<std::string>& paths);

  /// The run as if it had been one.
  const RunDescription& run() const { return run_; }
  std::uint64_t world_count() const { return run_.layout_names.size() * run_.accelerations.size(); }

  std::uint64_t block_count() const { return shards_.front().shard().shard.block_count(); }
  /// Worlds of as many of the first blocks.
  std::uint64_t worlds_of(std::uint64_t blocks) const { return std::min(blocks * block_worlds(), world_count()); }
  /// The block with which a merge goes on after so many worlds; an error if these end within a block.
  Result<std::uint64_t> block_after(std::uint64_t worlds) const;
  /// A block's columns, from the shard that has it.
  /// @param placed as of `ShardFile::read`
  Result<ColumnSet> read(std::uint64_t block, const AxisCounts& placed) const;

 private:
  /// Worlds of a block; the last one may have fewer.
  std::uint64_t block_worlds() const { return shards_.front().shard().shard.block * run_.accelerations.size(); }

  std::vector<ShardFile> shards_;  ///< by their part; empty ones of a run with few blocks are left out
  RunDescription run_;
};

/// Writes the results file of the run: the same bytes as if all had been simulated by one process, times aside. Blocks
/// are read one at a time and compressed on all threads. A merge that was interrupted goes on where its parts end.
/// @param lock     on the results file, held by the caller
/// @param observer `started` and `ended` are called when there are blocks to write, and nothing else
/// @return an error; none when `stop` ended it, and then the file is not there
std::optional<Error> merge_shards(const RunOfShards& shards, const std::string& results_path, const OutputLock& lock,
                                  Workers& workers, const StopRequest& stop, RunObserver& observer);

}  // namespace holdfast::internal
