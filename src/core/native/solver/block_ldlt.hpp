#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/native/solver/ldlt_kernels.hpp"

namespace holdfast::internal::native {

/// Two bodies that share contacts, by index.
using BodyPair = std::pair<std::uint32_t, std::uint32_t>;

/// Sparse L D Lᵀ of a symmetric positive definite matrix of 6×6 blocks, one row of blocks a body.
///
/// Bodies are eliminated in the order of least degree, which keeps L sparse (Tinney and Walker 1967; the graph is
/// small enough for bitsets). The structure is kept as long as the pairs stay the same.
class BlockFactor {
 public:
  /// Finds order and structure. Nothing is done when `count` and `pairs` are those of the last call.
  /// @param count bodies
  /// @param pairs that share a block off the diagonal, any order within a pair, without repetition
  void analyse(std::size_t count, std::span<const BodyPair> pairs);

  /// Place of a body in the order of elimination: the index that all of the following uses.
  std::uint32_t place(std::size_t body) const { return place_[body]; }

  /// Sets all blocks to zero.
  void clear();
  BodyBlock& diagonal(std::size_t place) { return diagonal_[place]; }
  /// Block of pair `i` of the last `analyse`; its row is the later place of the two, its column the earlier.
  BodyBlock& below(std::size_t pair) { return below_[pair_block_[pair]]; }
  /// Adds what contacts resist, see `add_resistance`.
  /// @param patch_pair a patch: index into the pairs of the last `analyse`, or `kNoPair`
  void add(std::span<const Patch> patches, std::span<const Arms> mid_arms, std::span<const std::uint32_t> patch_pair) {
    add_resistance(patches, mid_arms, patch_pair, pair_block_, diagonal_, below_);
  }

  /// Replaces the matrix by its factor.
  void factorise();
  /// Solves in place, rows by place.
  void solve(std::span<BodyVector> x) const;

 private:
  void eliminate();
  void list_updates();

  std::size_t count_ = 0;
  std::vector<BodyPair> pairs_;
  std::vector<std::uint32_t> place_;
  std::vector<std::uint32_t> pair_block_;
  FactorShape shape_;
  std::vector<BodyBlock> diagonal_, below_, scratch_;
  std::vector<std::uint64_t> graph_;       ///< a row of bits a body: its neighbours that are not eliminated
  std::vector<std::uint32_t> neighbours_;  ///< of one body
  std::vector<std::uint32_t> degree_;
  std::vector<std::uint32_t> block_at_row_;
};

}  // namespace holdfast::internal::native
