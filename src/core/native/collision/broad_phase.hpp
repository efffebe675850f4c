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

/// Finds the pairs of boxes that are near enough to touch, by a sweep along the axis on which they are spread out most
/// (sweep and prune, Cohen et al. 1995).
///
/// One object serves one world from step to step: it keeps the order along the axis, which hardly changes, and its
/// buffers, so that nothing is allocated once they are large enough. What it finds depends on the arguments alone.
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
  /// Bounds of a box: along the axis of the sweep, and along the two others.
  struct Entry {
    double low = 0.0, high = 0.0;
    double low_u = 0.0, high_u = 0.0;
    double low_v = 0.0, high_v = 0.0;
    std::uint32_t index = 0;
    bool awake = false;
  };

  void choose_axis(std::span<const Vec3> lower, std::span<const Vec3> upper);
  void read_bounds(std::span<const Vec3> lower, std::span<const Vec3> upper, std::span<const std::uint8_t> awake);
  void sort_entries();
  void sweep();
  void sort_pairs();

  int axis_ = 0;
  bool sorted_before_ = false;    ///< the entries are nearly in order, from the last call
  std::vector<Entry> entries_;    ///< in order of `low`
  std::vector<IndexPair> found_;  ///< in the order of the sweep, `found_count_` of them
  std::size_t found_count_ = 0;
  std::vector<IndexPair> pairs_;      ///< in the order of the result
  std::vector<std::uint32_t> first_;  ///< where the pairs of each i begin
};

}  // namespace holdfast::internal::native
