#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/shard.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/run_description.hpp"

namespace holdfast::internal {

/// Folder of the shards of a results file, and the path of one: itself a results file, with parts of its own.
std::string shards_folder(const std::string& results_path);
std::string shard_path(const std::string& results_path, std::uint64_t part, std::uint64_t parts);

/// A finished shard, from which blocks are read. The file is closed between two calls: there may be thousands.
class ShardFile {
 public:
  /// An error if the file is damaged, is no shard, or has not all of its layouts.
  static Result<ShardFile> open(const std::string& path);

  const std::string& path() const { return path_; }
  const ShardOfRun& shard() const { return *run_.shard; }
  /// Of the shard's run, with its own layouts alone.
  const RunDescription& run() const { return run_; }

  /// The layouts and worlds of successive layouts, as the merged file has them.
  /// @param begin, end layouts of this file
  /// @param placed     entries that the merged file has before them: their indices begin there
  Result<ColumnSet> read(std::uint64_t begin, std::uint64_t end, const AxisCounts& placed) const;

 private:
  std::string path_;
  RunDescription run_;
};

}  // namespace holdfast::internal
