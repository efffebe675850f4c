#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "app/screening.hpp"
#include "core/base/result.hpp"
#include "core/engine/run_inputs.hpp"
#include "core/model/shard.hpp"

namespace holdfast::internal {

/// A job that is divided into shards. What all of its layouts have to be looked at for is done once.
class DividedJob {
 public:
  /// @param whole  outlives this, as do its layouts
  /// @param shards how many
  DividedJob(const ScreeningJob& whole, const LayoutFiles& layouts, const std::vector<ReadAcceleration>& accelerations,
             std::uint64_t shards);

  /// Shards that have layouts: not more than there are blocks.
  std::uint64_t shards_with_layouts() const { return std::min(shard_.parts, shard_.block_count()); }

  /// The job of a shard, from 1: its layouts, and its results file, whose folder is made.
  Result<ScreeningJob> shard(std::uint64_t part) const;

 private:
  const ScreeningJob& whole_;
  const LayoutFiles& layouts_;
  ScreeningJob without_layouts_;
  Shard shard_;
  std::string fingerprint_;  ///< of the whole run, with contents
};

}  // namespace holdfast::internal
