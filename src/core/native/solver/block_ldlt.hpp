#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/native/solver/bit_rows.hpp"
#include "core/native/solver/contact_problem.hpp"
#include "core/native/solver/ldlt_kernels.hpp"

namespace holdfast::internal::native {

/// Sparse L D Lᵀ of a symmetric positive definite matrix of 6×6 blocks, one row of blocks per body.
///
/// Bodies are eliminated in the order of least degree, which keeps L sparse (Tinney and Walker 1967; the graph is
/// small enough for bitsets). The structure is kept as long as the pairs stay the same.
class BlockLdlt {
 public:
  /// Finds order and structure. False, and nothing is done, when `count` and `pairs` are those of the last call.
  /// @param count bodies
  /// @param pairs that share a block off the diagonal, any order within a pair, without repetition
  bool analyse(std::size_t count, std::span<const BodyPair> pairs);

  /// Index of a body in the order of elimination, which all of the following uses.
  std::uint32_t elimination_index(std::size_t body) const { return elimination_index_[body]; }

  /// The same of all bodies.
  std::span<const std::uint32_t> elimination_indices() const { return elimination_index_; }

  /// Sets all blocks to zero.
  void clear();
  BodyBlock& diagonal(std::size_t elimination_index) { return diagonal_[elimination_index]; }
  /// Block of pair `i` of the last `analyse`; its row is the later of the two indices, its column the
  /// earlier.
  BodyBlock& below(std::size_t pair) { return below_[pair_block_[pair]]; }
  /// Adds the bodies' masses and moments of inertia.
  void add(std::span<const ProblemBody> bodies);
  /// Adds the contacts' penalty, see `add_penalty`.
  /// @param constraint_pair a constraint: index into the pairs of the last `analyse`, or `kNoPair`
  void add(std::span<const ContactConstraint> constraints, std::span<const Arms> mid_arms,
           std::span<const std::uint32_t> constraint_pair) {
    add_penalty(constraints, mid_arms, {constraint_pair, pair_block_, diagonal_blocks(), blocks_below()});
  }

  /// Adds a matrix of each contact point, see `add_resistance`.
  void add(std::span<const ContactConstraint> constraints, std::span<const ConstraintMatrix> resistance,
           std::span<const std::uint32_t> constraint_pair) {
    add_resistance(constraints, resistance, {constraint_pair, pair_block_, diagonal_blocks(), blocks_below()});
  }

  /// Replaces the matrix by its factor.
  void factorise();
  /// Solves in place, rows by elimination index.
  void solve(std::span<BodyVector> x) const;

 private:
  static constexpr std::size_t kUnknown = ~std::size_t{0};

  void eliminate(std::size_t count);
  std::span<BodyBlock> diagonal_blocks() { return std::span(diagonal_).first(count_); }
  std::span<BodyBlock> blocks_below() { return std::span(below_).first(shape_.block_row.size()); }

  std::size_t count_ = kUnknown;  ///< bodies of the structure
  std::vector<BodyPair> pairs_;
  std::vector<std::uint32_t> elimination_index_;
  std::vector<std::uint32_t> pair_block_;
  LdltStructure shape_;
  std::vector<BodyBlock> diagonal_, below_, scratch_;  ///< as many as the structure has, and more; so is the factor
  std::vector<DiagonalFactor> factor_;
  BitRows graph_;                            ///< a body: its neighbours that are not eliminated
  BitRows of_degree_;                        ///< a degree: the bodies that have it and are not eliminated
  std::vector<std::uint32_t> degree_;        ///< a body
  std::vector<std::uint32_t> neighbours_;    ///< of one body
  std::vector<std::uint32_t> block_at_row_;  ///< of one column, while the matrix is factorised
};

}  // namespace holdfast::internal::native
