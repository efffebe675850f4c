// Arithmetic of the block factorisation, once for every instruction set, chosen at run time.
#include "core/native/solver/ldlt_kernels.hpp"

#include <array>

#include "core/native/solver/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/native/solver/ldlt_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/native/solver/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace holdfast::internal::native::HWY_NAMESPACE {
namespace {

HWY_INLINE Triple cross(const Triple& p, const std::array<double, 3>& n) {
  const Four x = Four::all(n[0]), y = Four::all(n[1]), z = Four::all(n[2]);
  return {{p.at[1] * z - p.at[2] * y, p.at[2] * x - p.at[0] * z, p.at[0] * y - p.at[1] * x}};
}

/// How a constraint's points, each at arm r with R = t I + d n nᵀ, resist when a body turns.
struct Lever {
  Triple arm, turn;          ///< r; r × n
  Triple tangential, extra;  ///< t r; d r × n
  double moment[3][3];       ///< torque from linear velocity, Σ t [r]ₓ + d (r × n) nᵀ
};
HWY_INLINE Lever lever(const std::array<Lanes, 3>& arms, const Four& t, const Four& d, const std::array<double, 3>& n) {
  Lever l;
  l.arm = Triple::load(arms);
  l.turn = cross(l.arm, n);
  l.tangential = t * l.arm;
  l.extra = d * l.turn;
  double r[3], m[3];
  for (std::size_t i = 0; i < 3; ++i) {
    r[i] = total(l.tangential.at[i]);
    m[i] = total(l.extra.at[i]);
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) l.moment[i][j] = m[i] * n[j];
  l.moment[0][1] -= r[2];
  l.moment[0][2] += r[1];
  l.moment[1][0] += r[2];
  l.moment[1][2] -= r[0];
  l.moment[2][0] -= r[1];
  l.moment[2][1] += r[0];
  return l;
}

/// Torque from angular velocity, Σ t ((p · q) I − q pᵀ) + d (p × n) (q × n)ᵀ, where torques act on p and q turns:
/// [p]ₓ [q]ₓᵀ = (p · q) I − q pᵀ.
HWY_INLINE void add_turning(const Lever& p, const Lever& q, double (&out)[3][3]) {
  const Four diagonal = dot(p.tangential, q.arm);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Four sum = p.extra.at[i] * q.turn.at[j] - q.arm.at[i] * p.tangential.at[j];
      out[i][j] = total(i == j ? sum + diagonal : sum);
    }
  }
}

/// block += sign · (linear, momentᵀ; moment, turning), moments of the row's and of the column's body.
HWY_INLINE void add_block(double sign, const double (&linear)[3][3], const double (&row_moment)[3][3],
                          const double (&column_moment)[3][3], const double (&turning)[3][3], bool transpose,
                          BodyBlock& block) {
  const Eight s = Eight::all(sign);
  for (std::size_t c = 0; c < 3; ++c) {
    alignas(64) double left[kPaddedRows] = {}, right[kPaddedRows] = {};
    for (std::size_t r = 0; r < 3; ++r) {
      left[r] = linear[r][c];
      left[3 + r] = row_moment[r][c];
      right[r] = column_moment[c][r];
      right[3 + r] = transpose ? turning[c][r] : turning[r][c];
    }
    (Eight::load(block.column[c]) + s * Eight::load(left)).store(block.column[c]);
    (Eight::load(block.column[3 + c]) + s * Eight::load(right)).store(block.column[3 + c]);
  }
}

/// Adds what a constraint resists, given its two levers and what it resists linear velocities with.
template <class AnyLever>
HWY_INLINE void add_constraint(const ContactConstraint& constraint, std::uint32_t pair, const double (&linear)[3][3],
                               const AnyLever& a, const AnyLever& b, const ContactBlocks& blocks) {
  const auto fixed = static_cast<std::int32_t>(blocks.diagonal.size());
  double turning[3][3];
  if (constraint.a != fixed) {
    add_turning(a, a, turning);
    add_block(1.0, linear, a.moment, a.moment, turning, false, blocks.diagonal[static_cast<std::size_t>(constraint.a)]);
  }
  if (constraint.b != fixed) {
    add_turning(b, b, turning);
    add_block(1.0, linear, b.moment, b.moment, turning, false, blocks.diagonal[static_cast<std::size_t>(constraint.b)]);
  }
  if (pair == kNoPair) return;
  BodyBlock& block = blocks.below[blocks.pair_block[pair]];
  add_turning(a, b, turning);
  if (constraint.a > constraint.b)
    add_block(-1.0, linear, a.moment, b.moment, turning, false, block);
  else
    add_block(-1.0, linear, b.moment, a.moment, turning, true, block);
}

HWY_ATTR void add_penalty_kernel(const ContactConstraint* constraints, const Arms* mid_arms, std::size_t count,
                                 const ContactBlocks& blocks) {
  for (std::size_t p = 0; p < count; ++p) {
    const ContactConstraint& constraint = constraints[p];
    const Arms& arms = mid_arms == nullptr ? constraint.arms : mid_arms[p];
    const std::array<double, 3>& n = constraint.directions[0];
    const Four t = Four::load(constraint.penalty[1].data());
    const Four d = Four::load(constraint.penalty[0].data()) - t;
    const double sum_t = total(t);
    const double sum_d = total(d);
    double linear[3][3];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) linear[i][j] = sum_d * n[i] * n[j] + (i == j ? sum_t : 0.0);
    add_constraint(constraint, blocks.constraint_pair[p], linear, lever(arms.a, t, d, n), lever(arms.b, t, d, n),
                   blocks);
  }
}

/// The same where each point has a matrix R of its own, in the container's frame.
struct MatrixLever {
  Triple arm;
  Triple torque[3];     ///< rows of [r]ₓ R
  double moment[3][3];  ///< torque from linear velocity, Σ [r]ₓ R
};
HWY_INLINE MatrixLever lever(const std::array<Lanes, 3>& arms, const Four (&r)[3][3]) {
  MatrixLever l;
  l.arm = Triple::load(arms);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    for (std::size_t c = 0; c < 3; ++c) {
      l.torque[i].at[c] = l.arm.at[j] * r[k][c] - l.arm.at[k] * r[j][c];
      l.moment[i][c] = total(l.torque[i].at[c]);
    }
  }
  return l;
}

/// Torque from angular velocity, Σ [p]ₓ R [q]ₓᵀ: its row i is q × row i of [p]ₓ R.
HWY_INLINE void add_turning(const MatrixLever& p, const MatrixLever& q, double (&out)[3][3]) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t k = (j + 1) % 3;
      const std::size_t l = (j + 2) % 3;
      out[i][j] = total(q.arm.at[k] * p.torque[i].at[l] - q.arm.at[l] * p.torque[i].at[k]);
    }
  }
}

HWY_ATTR void add_resistance_kernel(const ContactConstraint* constraints, const ConstraintMatrix* resistance,
                                    std::size_t count, const ContactBlocks& blocks) {
  for (std::size_t p = 0; p < count; ++p) {
    const ContactConstraint& constraint = constraints[p];
    const auto& directions = constraint.directions;
    Four own[3][3], half[3][3], r[3][3];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) own[i][j] = Four::load(resistance[p].entry[i][j].data());
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        half[i][j] = Four::all(directions[0][i]) * own[0][j] + Four::all(directions[1][i]) * own[1][j] +
                     Four::all(directions[2][i]) * own[2][j];
      }
    }
    double linear[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        r[i][j] = half[i][0] * Four::all(directions[0][j]) + half[i][1] * Four::all(directions[1][j]) +
                  half[i][2] * Four::all(directions[2][j]);
        linear[i][j] = total(r[i][j]);
      }
    }
    add_constraint(constraint, blocks.constraint_pair[p], linear, lever(constraint.arms.a, r),
                   lever(constraint.arms.b, r), blocks);
  }
}

/// out −= m sᵀ.
HWY_INLINE void subtract_product(const BodyBlock& m, const BodyBlock& s, BodyBlock& out) {
  Eight column[kBodyRows];
  for (int k = 0; k < kBodyRows; ++k) column[k] = Eight::load(m.column[k]);
  for (int c = 0; c < kBodyRows; ++c) {
    Eight sum = column[0] * Eight::all(s.column[0][c]);
    for (int k = 1; k < kBodyRows; ++k) sum = sum + column[k] * Eight::all(s.column[k][c]);
    (Eight::load(out.column[c]) - sum).store(out.column[c]);
  }
}

/// scaled = m l⁻ᵀ, then m = scaled d⁻¹.
HWY_INLINE void divide(const DiagonalFactor& factor, BodyBlock& m, BodyBlock& scaled) {
  Eight column[kBodyRows];
  for (int k = 0; k < kBodyRows; ++k) column[k] = Eight::load(m.column[k]);
  for (int c = 0; c < kBodyRows; ++c) {
    Eight sum = column[c];
    for (int k = 0; k < c; ++k) sum = sum + column[k] * Eight::all(factor.lower.column[k][c]);
    sum.store(scaled.column[c]);
    (sum * Eight::all(factor.inverse_d.row[c])).store(m.column[c]);
  }
}

/// Factorises a symmetric positive definite block. (Its inverse, in place of that of l, would lose twice as many digits
/// where a contact is much stiffer than another.)
HWY_INLINE void factorise(const BodyBlock& block, DiagonalFactor& factor) {
  double l[kBodyRows][kBodyRows];
  double d[kBodyRows];
  factor = DiagonalFactor{};
  for (int j = 0; j < kBodyRows; ++j) {
    double scaled[kBodyRows];
    d[j] = block.column[j][j];
    for (int k = 0; k < j; ++k) {
      scaled[k] = l[j][k] * d[k];
      d[j] -= l[j][k] * scaled[k];
    }
    const double inverse_d = factor.inverse_d.row[j] = 1.0 / d[j];
    for (int i = j + 1; i < kBodyRows; ++i) {
      double sum = block.column[j][i];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * scaled[k];
      l[i][j] = sum * inverse_d;
    }
  }
  // Column c of the inverse of l solves l x = e_c.
  for (int c = 0; c < kBodyRows; ++c) {
    double x[kBodyRows] = {};
    x[c] = 1.0;
    for (int i = c + 1; i < kBodyRows; ++i)
      for (int k = c; k < i; ++k) x[i] -= l[i][k] * x[k];
    for (int i = c; i < kBodyRows; ++i) factor.lower.column[c][i] = factor.upper.column[i][c] = x[i];
  }
}

HWY_ATTR void factorise_kernel(const LdltStructure& shape, BodyBlock* below, BodyBlock* diagonal,
                               DiagonalFactor* factor, BodyBlock* scratch) {
  const std::size_t columns = shape.column_begin.size() - 1;
  const std::size_t below_count = shape.block_row.size();
  for (std::size_t j = 0; j < columns; ++j) {
    factorise(diagonal[j], factor[j]);
    const std::size_t begin = shape.column_begin[j];
    for (std::size_t i = begin; i < shape.column_begin[j + 1]; ++i) divide(factor[j], below[i], scratch[i - begin]);
    for (std::size_t k = shape.update_begin[j]; k < shape.update_begin[j + 1]; ++k) {
      const BlockUpdate& update = shape.updates[k];
      BodyBlock& target = update.c < below_count ? below[update.c] : diagonal[update.c - below_count];
      subtract_product(below[update.l], scratch[update.b - begin], target);
    }
  }
}

/// m x.
HWY_INLINE Eight product(const BodyBlock& m, const double* x) {
  Eight sum = Eight::load(m.column[0]) * Eight::all(x[0]);
  for (int k = 1; k < kBodyRows; ++k) sum = sum + Eight::load(m.column[k]) * Eight::all(x[k]);
  return sum;
}

HWY_ATTR void solve_kernel(const LdltStructure& shape, const BodyBlock* below, const DiagonalFactor* factor,
                           BodyVector* x) {
  const std::size_t columns = shape.column_begin.size() - 1;
  for (std::size_t j = 0; j < columns; ++j) {
    const Eight own = product(factor[j].lower, x[j].row);
    own.store(x[j].row);
    for (std::size_t i = shape.column_begin[j]; i < shape.column_begin[j + 1]; ++i) {
      double* target = x[shape.block_row[i]].row;
      (Eight::load(target) - product(below[i], x[j].row)).store(target);
    }
    (own * Eight::load(factor[j].inverse_d.row)).store(x[j].row);
  }
  for (std::size_t j = columns; j-- > 0;) {
    if (shape.column_begin[j] != shape.column_begin[j + 1]) {
      Eight sum[kBodyRows];
      for (int k = 0; k < kBodyRows; ++k) sum[k] = Eight::all(0.0);
      for (std::size_t i = shape.column_begin[j]; i < shape.column_begin[j + 1]; ++i) {
        const Eight other = Eight::load(x[shape.block_row[i]].row);
        for (int k = 0; k < kBodyRows; ++k) sum[k] = sum[k] + Eight::load(below[i].column[k]) * other;
      }
      for (int k = 0; k < kBodyRows; ++k) {
        alignas(64) double lane[kPaddedRows];
        sum[k].store(lane);
        x[j].row[k] -= ((lane[0] + lane[1]) + (lane[2] + lane[3])) + (lane[4] + lane[5]);
      }
    }
    product(factor[j].upper, x[j].row).store(x[j].row);
  }
}

}  // namespace
}  // namespace holdfast::internal::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace holdfast::internal::native {

HWY_EXPORT(add_penalty_kernel);
HWY_EXPORT(add_resistance_kernel);
HWY_EXPORT(factorise_kernel);
HWY_EXPORT(solve_kernel);

void add_penalty(std::span<const ContactConstraint> constraints, std::span<const Arms> mid_arms,
                 const ContactBlocks& blocks) {
  HWY_DYNAMIC_DISPATCH(add_penalty_kernel)
  (constraints.data(), arms_or_null(mid_arms), constraints.size(), blocks);
}

void add_resistance(std::span<const ContactConstraint> constraints, std::span<const ConstraintMatrix> resistance,
                    const ContactBlocks& blocks) {
  HWY_DYNAMIC_DISPATCH(add_resistance_kernel)(constraints.data(), resistance.data(), constraints.size(), blocks);
}

void factorise(const LdltStructure& shape, std::span<BodyBlock> below, std::span<BodyBlock> diagonal,
               std::span<DiagonalFactor> factor, std::span<BodyBlock> scratch) {
  HWY_DYNAMIC_DISPATCH(factorise_kernel)(shape, below.data(), diagonal.data(), factor.data(), scratch.data());
}

void solve(const LdltStructure& shape, std::span<const BodyBlock> below, std::span<const DiagonalFactor> factor,
           std::span<BodyVector> x) {
  HWY_DYNAMIC_DISPATCH(solve_kernel)(shape, below.data(), factor.data(), x.data());
}

}  // namespace holdfast::internal::native
#endif  // HWY_ONCE
