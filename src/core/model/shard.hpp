#pragma once

#include <algorithm>
#include <cstdint>

namespace holdfast::internal {

/// Worlds of a block, about: the run is dealt out to shards in blocks.
inline constexpr std::uint64_t kBlockWorlds = 256;

/// A shard of a run: one of several parts that are simulated apart, on other machines for instance, and merged. The
/// layouts of the run are cut into blocks of `block` successive ones, and shard `part` of `parts` has the blocks
/// `part`, `part + parts`, … (cyclic, since neighbours in a list of layouts often cost the same).
struct Shard {
  std::uint64_t part = 1;     ///< from 1
  std::uint64_t parts = 1;    ///< shards of the run
  std::uint64_t block = 1;    ///< layouts of a block; the last block of the run may have fewer
  std::uint64_t layouts = 0;  ///< of the run

  /// Layouts that are cut into one block, for so many accelerations.
  static std::uint64_t block_of(std::uint64_t accelerations) {
    return std::max<std::uint64_t>(1, kBlockWorlds / std::max<std::uint64_t>(1, accelerations));
  }

  std::uint64_t block_count() const { return (layouts + block - 1) / block; }
};

}  // namespace holdfast::internal
