#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/native/patch.hpp"

namespace holdfast::native {

/// Rows that a body's six are padded to, so that a column of a block is a whole SIMD vector.
inline constexpr int kPaddedRows = 8;
inline constexpr int kBodyRows = 6;

/// Velocity, impulse or residual of a body: three linear rows, three angular ones, two zeros.
struct alignas(64) BodyVector {
  double row[kPaddedRows] = {};
};

/// A 6×6 matrix, column by column, each padded by zeros.
struct alignas(64) BodyBlock {
  double column[kBodyRows][kPaddedRows] = {};
};

/// Wrench on a body, summed apart for each lane of the patches; lanes are added in a fixed order.
struct alignas(64) LaneWrench {
  double row[kBodyRows][kLanes] = {};
};

/// First half of an iteration of the splitting: measures u = J v + allowance and finds where the iteration leads
/// from x = y − R z, to g = x − α R (u − z).
/// @param velocity   a body; the last entry, of what is fixed, is zero
/// @param relaxation α: 1 plain, 1.6 over-relaxed
/// @param u, g, r    a patch; r = g − x
/// @return largest |u − z|, m/s
double aim(std::span<const Patch> patches, std::span<const BodyVector> velocity, double relaxation,
           std::span<PatchVector> u, std::span<PatchVector> g, std::span<PatchVector> r);

/// Second half: projects x onto Coulomb's cone, sets impulse y = Π(x) and slip z = (y − x) / R, and adds
/// J_midᵀ (y + R (z − u)) to `wrench`.
/// @param mid_arms arms of the middle of the step, where impulses act; empty: those of the patches
/// @param wrench   a body, added to
void project(std::span<Patch> patches, std::span<const Arms> mid_arms, std::span<const PatchVector> x,
             std::span<const PatchVector> u, std::span<LaneWrench> wrench);

/// Σ a b / R over all points: an inner product of impulses.
double dot(std::span<const Patch> patches, std::span<const PatchVector> a, std::span<const PatchVector> b);

/// step = now − last, last = now.
void take_difference(std::span<const PatchVector> now, std::span<PatchVector> last, std::span<PatchVector> step);

/// x = x − Σ weight · history.
void subtract(std::span<const std::vector<PatchVector>> history, std::span<const double> weight,
              std::span<PatchVector> x);

/// Adds J_midᵀ y to `wrench`.
void add_impulses(std::span<const Patch> patches, std::span<const Arms> mid_arms, std::span<LaneWrench> wrench);

/// c −= l bᵀ, the step of the factorisation.
struct BlockUpdate {
  std::uint32_t c, l, b;
};

/// A patch that touches what is fixed has no block off the diagonal.
inline constexpr std::uint32_t kNoPair = ~0U;

/// Adds J_midᵀ R J_mid, what the contacts add to the bodies' mass, to A: the lower triangle of its diagonal blocks, and
/// all of those below.
/// @param mid_arms   arms of the middle of the step; empty: those of the patches
/// @param patch_pair a patch: index into `pair_block`, or `kNoPair`
/// @param pair_block a pair of bodies: its block of `below`, whose row is the later body and whose column the earlier
void add_resistance(std::span<const Patch> patches, std::span<const Arms> mid_arms,
                    std::span<const std::uint32_t> patch_pair, std::span<const std::uint32_t> pair_block,
                    std::span<BodyBlock> diagonal, std::span<BodyBlock> below);

/// Structure of a block factor, columns in order of elimination; made by `BlockFactor`.
struct FactorShape {
  std::vector<std::uint32_t> column_begin;  ///< first block of column j below the diagonal; one more than columns
  std::vector<std::uint32_t> block_row;     ///< row, in order of elimination, of a block below the diagonal
  std::vector<BlockUpdate> updates;         ///< of all columns; c counts blocks below the diagonal, then diagonals
  std::vector<std::uint32_t> update_begin;  ///< first update of column j; one more than columns
};

/// A = L D Lᵀ in place. On entry `below` and `diagonal` hold A's blocks, on exit L and D⁻¹.
/// @param scratch as many blocks as the longest column
void factorise(const FactorShape& shape, std::span<BodyBlock> below, std::span<BodyBlock> diagonal,
               std::span<BodyBlock> scratch);

/// Solves L D Lᵀ x = x in place; rows in order of elimination.
void solve(const FactorShape& shape, std::span<const BodyBlock> below, std::span<const BodyBlock> inverse_diagonal,
           std::span<BodyVector> x);

/// Instruction sets that this machine can run, best first; for tests.
std::vector<std::int64_t> instruction_sets();

/// Restricts the kernels to one of `instruction_sets()`, or back to the best with 0; for tests, not while worlds run.
void use_instruction_set(std::int64_t set);

}  // namespace holdfast::native
