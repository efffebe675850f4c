#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/native/solver/body_block.hpp"
#include "core/native/solver/contact_constraint.hpp"

// The inner loops over the blocks of the matrix.

namespace holdfast::internal::native {

/// The blocks of the matrix A that contacts add to: the lower triangle of those on the diagonal, and all below.
struct ContactBlocks {
  std::span<const std::uint32_t> constraint_pair;  ///< a constraint: index into `pair_block`, or `kNoPair`
  /// A pair of bodies: its block of `below`, whose row is the later body and whose column the earlier.
  std::span<const std::uint32_t> pair_block;
  std::span<BodyBlock> diagonal, below;
};

/// Adds J_midᵀ R J_mid, what the contacts add to the bodies' mass, to A.
/// @param mid_arms   arms of the middle of the step; empty: those of the constraints
void add_penalty(std::span<const ContactConstraint> constraints, std::span<const Arms> mid_arms,
                 const ContactBlocks& blocks);

/// The same with a 3×3 matrix R of each point, which acts at the arms of the constraints.
void add_resistance(std::span<const ContactConstraint> constraints, std::span<const ConstraintMatrix> resistance,
                    const ContactBlocks& blocks);

/// Structure of a block factor, columns in order of elimination; made by `BlockLdlt`.
struct LdltStructure {
  std::vector<std::uint32_t> column_begin;  ///< first block of column j below the diagonal; one more than columns
  std::vector<std::uint32_t> block_row;     ///< row, in order of elimination, of a block below the diagonal; a column's
                                            ///< are in increasing order
};

/// Factor l d lᵀ of a diagonal block, d diagonal: l⁻¹, its transpose, and d⁻¹.
struct DiagonalFactor {
  BodyBlock lower, upper;
  BodyVector inverse_d;
};

/// A = L D Lᵀ. On entry `below` and `diagonal` hold A's blocks. On exit, `factor` holds the factors l d lᵀ of the
/// diagonal blocks of D, `below` the blocks of L times l, and `diagonal` nothing of use.
/// Where two blocks l and b are in a column, the block in the row of l and the column of b's row is there too: it takes
/// −l bᵀ.
/// @param scratch      as many blocks as the longest column
/// @param block_at_row as many numbers as columns
void factorise(const LdltStructure& shape, std::span<BodyBlock> below, std::span<BodyBlock> diagonal,
               std::span<DiagonalFactor> factor, std::span<BodyBlock> scratch, std::span<std::uint32_t> block_at_row);

/// Solves L D Lᵀ x = x in place; rows in order of elimination.
void solve(const LdltStructure& shape, std::span<const BodyBlock> below, std::span<const DiagonalFactor> factor,
           std::span<BodyVector> x);

}  // namespace holdfast::internal::native
