#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/engine/world_record.hpp"
#include "core/model/verdict.hpp"

namespace holdfast::internal {

/// In which order the accelerations of a layout are tried when the first failure ends its evaluation: the one that most
/// layouts failed comes first, equals in the order of the run.
///
/// The order is drawn up at the begin of a block of layouts, from the layouts of the blocks before it, and holds for
/// the whole block: what is simulated depends on the inputs alone, neither on threads nor on time. Blocks end after 8,
/// 16, 32, 64, 128, 256, 512, 768, … layouts of the run.
class FailureOrder {
 public:
  FailureOrder(std::size_t acceleration_count, const EngineTraits& traits);

  /// Opens the block that a layout is in, unless it is open. Layouts come by rising index. One that the engine takes
  /// together with others is in the block of the first of them.
  void enter(std::size_t layout);

  /// Counts a world of a layout that was entered.
  /// @param thresholds of the run
  void count(const WorldRecord& world, const Thresholds& thresholds);

  /// Counts a layout that an acceleration rejects.
  void count_rejection(std::size_t acceleration) { ++failures_[acceleration]; }

  /// For another run of the same accelerations: with these failures, and no block open.
  FailureOrder for_next_run() const;

  /// Indices of the accelerations, for the layouts of the open block.
  std::span<const std::size_t> order() const { return order_; }

  /// First layout after the open block.
  std::size_t block_end() const { return block_end_; }

 private:
  std::vector<std::uint64_t> failures_;  ///< layouts that failed, one count per acceleration
  std::vector<std::size_t> order_;
  std::size_t layouts_per_unit_;
  std::size_t block_end_ = 0;
};

/// Whether what became of a world rejects its layout: it neither stayed, nor failed to be simulated.
bool rejects(Verdict verdict);
bool rejects(const WorldRecord& world, const Thresholds& thresholds);

}  // namespace holdfast::internal
