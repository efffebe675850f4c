#include "core/native/collision/broad_phase.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/native/constants.hpp"

namespace holdfast::internal::native {

namespace {

/// False where a number is none.
bool overlap(const Vec3& lower, const Vec3& upper, const Vec3& other_lower, const Vec3& other_upper) {
  return (lower.array() <= other_upper.array()).all() && (other_lower.array() <= upper.array()).all();
}

bool is_within(const Vec3& lower, const Vec3& upper, const Vec3& outer_lower, const Vec3& outer_upper) {
  return (outer_lower.array() <= lower.array()).all() && (upper.array() <= outer_upper.array()).all();
}

bool is_proper(const Vec3& lower, const Vec3& upper) { return (lower.array() <= upper.array()).all(); }

void insert(std::vector<std::uint32_t>& sorted, std::uint32_t index) {
  sorted.insert(std::lower_bound(sorted.begin(), sorted.end(), index), index);
}

void erase(std::vector<std::uint32_t>& sorted, std::uint32_t index) {
  sorted.erase(std::lower_bound(sorted.begin(), sorted.end(), index));
}

}  // namespace

std::span<const IndexPair> BroadPhase::find_pairs(std::span<const Vec3> lower, std::span<const Vec3> upper,
                                                  std::span<const std::uint8_t> awake) {
  assert(lower.size() == upper.size() && lower.size() == awake.size());
  const auto count = static_cast<std::uint32_t>(lower.size());
  // Surroundings without numbers hold no box and overlap none.
  const Vec3 none = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  if (boxes_.size() != count) boxes_.assign(count, {.lower = none, .upper = none, .margin = kLeastSurroundings});
  for (std::uint32_t i = 0; i < count; ++i) {
    ++boxes_[i].calls;
    if (!is_within(lower[i], upper[i], boxes_[i].lower, boxes_[i].upper)) renew(i, lower[i], upper[i]);
  }
  pairs_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!is_proper(lower[i], upper[i])) continue;
    const std::vector<std::uint32_t>& neighbours = boxes_[i].neighbours;
    for (auto j = std::upper_bound(neighbours.begin(), neighbours.end(), i); j != neighbours.end(); ++j)
      if ((awake[i] != 0 || awake[*j] != 0) && is_proper(lower[*j], upper[*j]) &&
          overlap(lower[i], upper[i], lower[*j], upper[*j]))
        pairs_.push_back({i, *j});
  }
  return pairs_;
}

/// Gives a box new surroundings, larger ones where it left the last ones soon, and looks for its neighbours.
void BroadPhase::renew(std::uint32_t index, const Vec3& lower, const Vec3& upper) {
  Surroundings& box = boxes_[index];
  if (box.calls < kHorizon / 2) box.margin *= 2.0;
  if (box.calls > 2 * kHorizon) box.margin = std::max(0.5 * box.margin, kLeastSurroundings);
  box.calls = 0;
  box.lower = lower.array() - box.margin;
  box.upper = upper.array() + box.margin;
  for (const std::uint32_t other : box.neighbours) erase(boxes_[other].neighbours, index);
  box.neighbours.clear();
  for (std::uint32_t other = 0; other < boxes_.size(); ++other) {
    if (other == index || !overlap(box.lower, box.upper, boxes_[other].lower, boxes_[other].upper)) continue;
    box.neighbours.push_back(other);
    insert(boxes_[other].neighbours, index);
  }
}

}  // namespace holdfast::internal::native
