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

/// Three components of a vector at the points of a constraint.
struct Triple {
  Four at[3];
};
HWY_INLINE Triple operator*(const Four& s, const Triple& v) { return {{s * v.at[0], s * v.at[1], s * v.at[2]}}; }
HWY_INLINE Four dot(const Triple& p, const Triple& q) {
  return p.at[0] * q.at[0] + p.at[1] * q.at[1] + p.at[2] * q.at[2];
}
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
  l.arm = {{Four::load(arms[0].data()), Four::load(arms[1].data()), Four::load(arms[2].data())}};
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

HWY_ATTR void add_penalty_kernel(const ContactConstraint* constraints, const Arms* mid_arms, std::size_t count,
                                 const std::uint32_t* constraint_pair, const std::uint32_t* pair_block,
                                 std::int32_t fixed, BodyBlock* diagonal, BodyBlock* below) {
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
    double turning[3][3];
    const Lever a = lever(arms.a, t, d, n);
    const Lever b = lever(arms.b, t, d, n);
    if (constraint.a != fixed) {
      add_turning(a, a, turning);
      add_block(1.0, linear, a.moment, a.moment, turning, false, diagonal[constraint.a]);
    }
    if (constraint.b != fixed) {
      add_turning(b, b, turning);
      add_block(1.0, linear, b.moment, b.moment, turning, false, diagonal[constraint.b]);
    }
    if (constraint_pair[p] == kNoPair) continue;
    BodyBlock& block = below[pair_block[constraint_pair[p]]];
    add_turning(a, b, turning);
    if (constraint.a > constraint.b)
      add_block(-1.0, linear, a.moment, b.moment, turning, false, block);
    else
      add_block(-1.0, linear, b.moment, a.moment, turning, true, block);
  }
}

/// out = m sᵀ for blocks, or out − m sᵀ.
template <bool kSubtract>
HWY_INLINE void multiply_transposed(const BodyBlock& m, const BodyBlock& s, BodyBlock& out) {
  Eight column[kBodyRows];
  for (int k = 0; k < kBodyRows; ++k) column[k] = Eight::load(m.column[k]);
  for (int c = 0; c < kBodyRows; ++c) {
    Eight sum = column[0] * Eight::all(s.column[0][c]);
    for (int k = 1; k < kBodyRows; ++k) sum = sum + column[k] * Eight::all(s.column[k][c]);
    (kSubtract ? Eight::load(out.column[c]) - sum : sum).store(out.column[c]);
  }
}

/// Inverse of a symmetric positive definite block through its L D Lᵀ.
HWY_INLINE void invert(BodyBlock& block) {
  double l[kBodyRows][kBodyRows];
  double d[kBodyRows];
  double inverse_d[kBodyRows];
  for (int j = 0; j < kBodyRows; ++j) {
    double scaled[kBodyRows];
    d[j] = block.column[j][j];
    for (int k = 0; k < j; ++k) {
      scaled[k] = l[j][k] * d[k];
      d[j] -= l[j][k] * scaled[k];
    }
    inverse_d[j] = 1.0 / d[j];
    for (int i = j + 1; i < kBodyRows; ++i) {
      double sum = block.column[j][i];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * scaled[k];
      l[i][j] = sum * inverse_d[j];
    }
  }
  // Column c of the inverse solves L D Lᵀ x = e_c; only rows from c on are needed, the rest is symmetric.
  for (int c = 0; c < kBodyRows; ++c) {
    double x[kBodyRows] = {};
    x[c] = 1.0;
    for (int i = c + 1; i < kBodyRows; ++i)
      for (int k = c; k < i; ++k) x[i] -= l[i][k] * x[k];
    for (int i = c; i < kBodyRows; ++i) x[i] *= inverse_d[i];
    for (int i = kBodyRows - 1; i >= c; --i)
      for (int k = i + 1; k < kBodyRows; ++k) x[i] -= l[k][i] * x[k];
    for (int i = c; i < kBodyRows; ++i) block.column[c][i] = block.column[i][c] = x[i];
  }
}

HWY_ATTR void factorise_kernel(const LdltStructure& shape, BodyBlock* below, BodyBlock* diagonal, BodyBlock* scratch) {
  const std::size_t columns = shape.column_begin.size() - 1;
  const std::size_t below_count = shape.block_row.size();
  for (std::size_t j = 0; j < columns; ++j) {
    invert(diagonal[j]);
    const std::size_t begin = shape.column_begin[j];
    for (std::size_t i = begin; i < shape.column_begin[j + 1]; ++i) {
      scratch[i - begin] = below[i];
      multiply_transposed<false>(scratch[i - begin], diagonal[j], below[i]);
    }
    for (std::size_t k = shape.update_begin[j]; k < shape.update_begin[j + 1]; ++k) {
      const BlockUpdate& update = shape.updates[k];
      BodyBlock& target = update.c < below_count ? below[update.c] : diagonal[update.c - below_count];
      multiply_transposed<true>(below[update.l], scratch[update.b - begin], target);
    }
  }
}

HWY_ATTR void solve_kernel(const LdltStructure& shape, const BodyBlock* below, const BodyBlock* inverse_diagonal,
                           BodyVector* x) {
  const std::size_t columns = shape.column_begin.size() - 1;
  for (std::size_t j = 0; j < columns; ++j) {
    for (std::size_t i = shape.column_begin[j]; i < shape.column_begin[j + 1]; ++i) {
      double* target = x[shape.block_row[i]].row;
      Eight sum = Eight::load(below[i].column[0]) * Eight::all(x[j].row[0]);
      for (int k = 1; k < kBodyRows; ++k) sum = sum + Eight::load(below[i].column[k]) * Eight::all(x[j].row[k]);
      (Eight::load(target) - sum).store(target);
    }
  }
  for (std::size_t j = columns; j-- > 0;) {
    const BodyBlock& inverse = inverse_diagonal[j];
    Eight own = Eight::load(inverse.column[0]) * Eight::all(x[j].row[0]);
    for (int k = 1; k < kBodyRows; ++k) own = own + Eight::load(inverse.column[k]) * Eight::all(x[j].row[k]);
    own.store(x[j].row);
    if (shape.column_begin[j] == shape.column_begin[j + 1]) continue;
    Eight product[kBodyRows];
    for (int k = 0; k < kBodyRows; ++k) product[k] = Eight::all(0.0);
    for (std::size_t i = shape.column_begin[j]; i < shape.column_begin[j + 1]; ++i) {
      const Eight other = Eight::load(x[shape.block_row[i]].row);
      for (int k = 0; k < kBodyRows; ++k) product[k] = product[k] + Eight::load(below[i].column[k]) * other;
    }
    for (int k = 0; k < kBodyRows; ++k) {
      alignas(64) double lane[kPaddedRows];
      product[k].store(lane);
      x[j].row[k] -= ((lane[0] + lane[1]) + (lane[2] + lane[3])) + (lane[4] + lane[5]);
    }
  }
}

}  // namespace
}  // namespace holdfast::internal::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace holdfast::internal::native {

HWY_EXPORT(add_penalty_kernel);
HWY_EXPORT(factorise_kernel);
HWY_EXPORT(solve_kernel);

void add_penalty(std::span<const ContactConstraint> constraints, std::span<const Arms> mid_arms,
                 std::span<const std::uint32_t> constraint_pair, std::span<const std::uint32_t> pair_block,
                 std::span<BodyBlock> diagonal, std::span<BodyBlock> below) {
  HWY_DYNAMIC_DISPATCH(add_penalty_kernel)
  (constraints.data(), arms_or_null(mid_arms), constraints.size(), constraint_pair.data(), pair_block.data(),
   static_cast<std::int32_t>(diagonal.size()), diagonal.data(), below.data());
}

void factorise(const LdltStructure& shape, std::span<BodyBlock> below, std::span<BodyBlock> diagonal,
               std::span<BodyBlock> scratch) {
  HWY_DYNAMIC_DISPATCH(factorise_kernel)(shape, below.data(), diagonal.data(), scratch.data());
}

void solve(const LdltStructure& shape, std::span<const BodyBlock> below, std::span<const BodyBlock> inverse_diagonal,
           std::span<BodyVector> x) {
  HWY_DYNAMIC_DISPATCH(solve_kernel)(shape, below.data(), inverse_diagonal.data(), x.data());
}

}  // namespace holdfast::internal::native
#endif  // HWY_ONCE
