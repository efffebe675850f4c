#include "parallel/screening/failure_order.hpp"

#include <algorithm>
#include <numeric>

namespace holdfast::internal {

namespace {

constexpr std::size_t kFirstBlock = 8;
constexpr std::size_t kLongestBlock = 256;

Verdict verdict_of(const WorldRecord& world, const Thresholds& thresholds) {
  return judge_world(world.row, world.end, by_run(thresholds)).verdict;
}

}  // namespace

FailureOrder::FailureOrder(std::size_t acceleration_count, const EngineTraits& traits)
    : failures_(acceleration_count),
      order_(acceleration_count),
      layouts_per_unit_(std::max<std::size_t>(1, traits.layouts_per_unit)) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
}

void FailureOrder::enter(std::size_t layout) {
  const std::size_t first = layout - layout % layouts_per_unit_;
  if (first < block_end_) return;
  while (block_end_ <= first)
    block_end_ = block_end_ == 0 ? kFirstBlock : block_end_ + std::min(block_end_, kLongestBlock);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(),
                   [this](std::size_t a, std::size_t b) { return failures_[a] > failures_[b]; });
}

void FailureOrder::count(const WorldRecord& world, const Thresholds& thresholds) {
  if (rejects(world, thresholds)) count_rejection(world.row.acceleration);
}

FailureOrder FailureOrder::for_next_run() const {
  FailureOrder next = *this;
  next.block_end_ = 0;
  return next;
}

bool rejects(const WorldRecord& world, const Thresholds& thresholds) { return rejects(verdict_of(world, thresholds)); }

bool rejects(Verdict verdict) {
  return verdict != Verdict::stayed && verdict != Verdict::failed && verdict != Verdict::not_needed;
}

}  // namespace holdfast::internal
