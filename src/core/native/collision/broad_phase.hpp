#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vector.hpp"

namespace holdfast::internal::native {

/// Two boxes that may touch, by their indices in the caller's arrays; i < j.
struct IndexPair {
  std::uint32_t i = 0;
  std::uint32_t j = 0;
  friend bool operator==(const IndexPair&, const IndexPair&) = default;
};

/// Finds the pairs of boxes that are near enough to touch. Each box has a list of those whose surroundings overlap its
/// own, as in the neighbour lists of molecular dynamics (Verlet 1967); the list is made anew, by a comparison with all
/// boxes, where the box leaves its surroundings. Most boxes do not for many steps.
///
/// One object serves one world from step to step. What it finds depends on the arguments alone.
class BroadPhase {
 public:
  /// All pairs whose bounds overlap or touch and of which at least one box is `awake` (not 0), sorted by i, then j.
  ///
  /// `lower` and `upper` are the corners of each box's bounds, container frame, m, grown by the caller's margin; the
  /// three spans are of one length. Bounds that are not numbers, or reversed, overlap none. The pairs are
  /// owned by the object and valid until the next call.
  std::span<const IndexPair> find_pairs(std::span<const Vec3> lower, std::span<const Vec3> upper,
                                        std::span<const std::uint8_t> awake);

 private:
  /// Where a box can be without a look at the others.
  struct Surroundings {
    Vec3 lower, upper;
    double margin = 0.0;                    ///< around the box when it was last in the middle, m
    std::uint32_t calls = 0;                ///< since then
    std::vector<std::uint32_t> neighbours;  ///< boxes whose surroundings overlap these, sorted
  };

  void renew(std::uint32_t index, const Vec3& lower, const Vec3& upper);

  std::vector<Surroundings> boxes_;
  std::vector<IndexPair> pairs_;
};

}  // namespace holdfast::internal::native
