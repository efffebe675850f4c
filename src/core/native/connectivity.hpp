#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/native/scene.hpp"

namespace holdfast::internal::native {

/// The islands of a world: bodies that active manifolds join, in the order of their first bodies.
class Connectivity {
 public:
  /// Island of a fixed body.
  static constexpr std::uint32_t kNone = ~0U;

  /// Finds the islands anew. Views of earlier ones are no longer valid.
  void find(const Bodies& bodies, const std::vector<Manifold>& manifolds);

  std::size_t size() const { return ranges_.size(); }

  /// Bodies and manifolds of an island, each in their own order.
  IslandView operator[](std::size_t island) const;

  /// The island of a body, or `kNone`.
  std::uint32_t of(std::size_t body) const { return island_of_[body]; }

  /// Whether a body's island is a large one; false for sides, and for what belongs to none.
  bool is_in_large_island(std::int32_t body) const;

 private:
  /// Bodies of one island as a range of `members_`, manifolds inside as a range of `inside_`.
  struct Range {
    std::size_t body_begin = 0, body_end = 0;
    std::size_t manifold_begin = 0, manifold_end = 0;
  };

  std::vector<Range> ranges_;
  std::vector<std::uint32_t> members_, inside_;
  std::vector<std::uint32_t> root_;       ///< a body: another body of its island; itself: the root of the island
  std::vector<std::uint32_t> island_of_;  ///< of a body
  std::vector<std::pair<std::int32_t, std::int32_t>> ends_;  ///< a and b of a manifold
  std::vector<std::uint32_t> island_of_manifold_;
};

}  // namespace holdfast::internal::native
