#include "core/native/collision/broad_phase.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

bool is_proper(const Vec3& lower, const Vec3& upper) {
  return lower[0] <= upper[0] && lower[1] <= upper[1] && lower[2] <= upper[2];
}

}  // namespace

std::span<const IndexPair> BroadPhase::find_pairs(std::span<const Vec3> lower, std::span<const Vec3> upper,
                                                  std::span<const std::uint8_t> awake) {
  assert(lower.size() == upper.size() && lower.size() == awake.size());
  if (entries_.size() != lower.size()) {
    entries_.resize(lower.size());
    for (std::size_t i = 0; i < entries_.size(); ++i) entries_[i].index = static_cast<std::uint32_t>(i);
    sorted_before_ = false;
  }
  choose_axis(lower, upper);
  read_bounds(lower, upper, awake);
  sort_entries();
  sweep();
  sort_pairs();
  return pairs_;
}

void BroadPhase::choose_axis(std::span<const Vec3> lower, std::span<const Vec3> upper) {
  Vec3 least = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 most = -least;
  for (std::size_t i = 0; i < lower.size(); ++i) {
    if (!is_proper(lower[i], upper[i])) continue;
    for (int k = 0; k < 3; ++k) {
      // Twice the middle serves as well as the middle.
      const double middle = lower[i][k] + upper[i][k];
      least[k] = std::min(least[k], middle);
      most[k] = std::max(most[k], middle);
    }
  }
  const Vec3 spread = most - least;
  int best = spread[1] > spread[0] ? 1 : 0;
  if (spread[2] > spread[best]) best = 2;
  if (sorted_before_ && !(spread[best] > kBetterSweepAxis * spread[axis_])) return;
  if (best != axis_) sorted_before_ = false;
  axis_ = best;
}

void BroadPhase::read_bounds(std::span<const Vec3> lower, std::span<const Vec3> upper,
                             std::span<const std::uint8_t> awake) {
  const int u = (axis_ + 1) % 3;
  const int v = (axis_ + 2) % 3;
  for (Entry& entry : entries_) {
    const Vec3& low = lower[entry.index];
    const Vec3& high = upper[entry.index];
    entry.awake = awake[entry.index] != 0;
    if (is_proper(low, high)) {
      entry.low = low[axis_], entry.high = high[axis_];
      entry.low_u = low[u], entry.high_u = high[u];
      entry.low_v = low[v], entry.high_v = high[v];
    } else {
      // Last in the order, which must hold for the others, and never equal to anything.
      entry.low = std::numeric_limits<double>::infinity();
      entry.high = entry.low_u = entry.high_u = entry.low_v = entry.high_v = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

void BroadPhase::sort_entries() {
  if (!std::exchange(sorted_before_, true)) {
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.low < b.low; });
    return;
  }
  for (std::size_t i = 1; i < entries_.size(); ++i) {
    if (entries_[i - 1].low <= entries_[i].low) continue;
    const Entry moved = entries_[i];
    std::size_t slot = i;
    for (; slot > 0 && entries_[slot - 1].low > moved.low; --slot) entries_[slot] = entries_[slot - 1];
    entries_[slot] = moved;
  }
}

void BroadPhase::sweep() {
  const std::size_t count = entries_.size();
  std::size_t used = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Entry& a = entries_[i];
    // Room for all that may follow. Whether two boxes overlap cannot be predicted: a pair is always written, and
    // counted only if it is one, which halves the time of large worlds.
    if (found_.size() < used + count) found_.resize(2 * (used + count));
    for (std::size_t j = i + 1; j < count && entries_[j].low <= a.high; ++j) {
      const Entry& b = entries_[j];
      const bool overlap_u = (a.low_u <= b.high_u) & (b.low_u <= a.high_u);
      const bool overlap_v = (a.low_v <= b.high_v) & (b.low_v <= a.high_v);
      found_[used] = {std::min(a.index, b.index), std::max(a.index, b.index)};
      used += static_cast<std::size_t>(overlap_u & overlap_v & (a.awake | b.awake));
    }
  }
  found_count_ = used;
}

/// Dealt out to their first boxes, then sorted by insertion: a box has few neighbours.
void BroadPhase::sort_pairs() {
  first_.assign(entries_.size() + 1, 0);
  for (const IndexPair& pair : std::span(found_).first(found_count_)) ++first_[pair.i + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  pairs_.resize(found_count_);
  for (const IndexPair& pair : std::span(found_).first(found_count_)) pairs_[first_[pair.i]++] = pair;
  const auto before = [](const IndexPair& a, const IndexPair& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; };
  for (std::size_t n = 1; n < pairs_.size(); ++n) {
    const IndexPair moved = pairs_[n];
    std::size_t slot = n;
    for (; slot > 0 && before(moved, pairs_[slot - 1]); --slot) pairs_[slot] = pairs_[slot - 1];
    pairs_[slot] = moved;
  }
}

}  // namespace holdfast::internal::native
