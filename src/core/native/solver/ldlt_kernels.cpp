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

/// Sums over the lanes of three components, as a vector's rows; the fourth is zero.
HWY_INLINE Four totals(const Four& x, const Four& y, const Four& z) { return totals(x, y, z, Four::all(0.0)); }
HWY_INLINE Four totals(const Triple& v) { return totals(v.at[0], v.at[1], v.at[2]); }

HWY_INLINE Four negative(const Four& x) { return Four::all(0.0) - x; }

/// A 3×3 matrix by its columns, or by its rows.
struct Columns {
  Four of[3];
};

/// n nᵀ times a number, plus another on the diagonal.
HWY_INLINE Columns outer_square(double factor, const Direction& n, double diagonal) {
  Columns out;
  const Four scaled = Four::all(factor) * Four::load(n.data());
  for (std::size_t j = 0; j < 3; ++j) {
    alignas(64) static constexpr double kUnit[3][kLanes] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    out.of[j] = scaled * Four::all(n[j]) + Four::all(diagonal) * Four::load(kUnit[j]);
  }
  return out;
}

/// How a constraint's points, each at arm r with R = t I + d n nᵀ, resist when a body turns.
struct Lever {
  Triple arm, turn;             ///< r; r × n
  Triple tangential, extra;     ///< t r; d r × n
  Columns moment, moment_rows;  ///< torque from linear velocity, Σ t [r]ₓ + d (r × n) nᵀ
};
HWY_INLINE Lever lever(const std::array<Lanes, 3>& arms, const Four& t, const Four& d, const Direction& n) {
  Lever l;
  l.arm = Triple::load(arms);
  l.turn = cross(l.arm, {{Four::all(n[0]), Four::all(n[1]), Four::all(n[2])}});
  l.tangential = t * l.arm;
  l.extra = d * l.turn;
  const Four zero = Four::all(0.0);
  const Triple& r = l.tangential;
  // The columns of Σ t [r]ₓ, which are the opposites of its rows.
  const Four skew[3] = {totals(zero, r.at[2], negative(r.at[1])), totals(negative(r.at[2]), zero, r.at[0]),
                        totals(r.at[1], negative(r.at[0]), zero)};
  alignas(64) double extra[kLanes];
  const Four sum = totals(l.extra);
  sum.store(extra);
  const Four normal = Four::load(n.data());
  for (std::size_t i = 0; i < 3; ++i) {
    l.moment.of[i] = sum * Four::all(n[i]) + skew[i];
    l.moment_rows.of[i] = Four::all(extra[i]) * normal - skew[i];
  }
  return l;
}

/// Torque from angular velocity, Σ t ((p · q) I − q pᵀ) + d (p × n) (q × n)ᵀ, where torques act on p and q turns:
/// [p]ₓ [q]ₓᵀ = (p · q) I − q pᵀ. By its columns, or, transposed, by its rows.
template <bool kTransposed>
HWY_INLINE Columns turning(const Lever& p, const Lever& q) {
  const Four diagonal = dot(p.tangential, q.arm);
  const auto entry = [&](std::size_t i, std::size_t j) HWY_ATTR {
    const Four sum = p.extra.at[i] * q.turn.at[j] - q.arm.at[i] * p.tangential.at[j];
    return i == j ? sum + diagonal : sum;
  };
  Columns out;
  for (std::size_t k = 0; k < 3; ++k)
    out.of[k] =
        kTransposed ? totals(entry(k, 0), entry(k, 1), entry(k, 2)) : totals(entry(0, k), entry(1, k), entry(2, k));
  return out;
}

/// Adds (linear, column_momentᵀ; row_moment, turning) to a block, or subtracts it.
template <bool kSubtracts>
HWY_INLINE void add_block(const Columns& linear, const Columns& row_moment, const Columns& column_moment_rows,
                          const Columns& turning, BodyBlock& block) {
  const auto add = [](const Four& x, double* to)
                       HWY_ATTR { (kSubtracts ? Four::load(to) - x : Four::load(to) + x).store(to); };
  for (std::size_t c = 0; c < 3; ++c) {
    add(linear.of[c], block.column[c]);
    add(row_moment.of[c], block.column[c] + kAngularRow);
    add(column_moment_rows.of[c], block.column[3 + c]);
    add(turning.of[c], block.column[3 + c] + kAngularRow);
  }
}

/// Adds what a constraint resists, given its two levers and what it resists linear velocities with.
template <class AnyLever>
HWY_INLINE void add_constraint(const ContactConstraint& constraint, std::uint32_t pair, const Columns& linear,
                               const AnyLever& a, const AnyLever& b, const ContactBlocks& blocks) {
  const auto fixed = static_cast<std::int32_t>(blocks.diagonal.size());
  const auto add_own = [&](std::int32_t body, const AnyLever& own) HWY_ATTR {
    if (body == fixed) return;
    add_block<false>(linear, own.moment, own.moment_rows, turning<false>(own, own),
                     blocks.diagonal[static_cast<std::size_t>(body)]);
  };
  add_own(constraint.a, a);
  add_own(constraint.b, b);
  if (pair == kNoPair) return;
  BodyBlock& block = blocks.below[blocks.pair_block[pair]];
  if (constraint.a > constraint.b)
    add_block<true>(linear, a.moment, b.moment_rows, turning<false>(a, b), block);
  else
    add_block<true>(linear, b.moment, a.moment_rows, turning<true>(a, b), block);
}

HWY_ATTR void add_penalty_kernel(const ContactConstraint* constraints, const Arms* mid_arms, std::size_t count,
                                 const ContactBlocks& blocks) {
  for (std::size_t p = 0; p < count; ++p) {
    const ContactConstraint& constraint = constraints[p];
    const Arms& arms = mid_arms == nullptr ? constraint.arms : mid_arms[p];
    const Direction& n = constraint.directions[0];
    const Four t = Four::load(constraint.penalty[1].data());
    const Four d = Four::load(constraint.penalty[0].data()) - t;
    add_constraint(constraint, blocks.constraint_pair[p], outer_square(total(d), n, total(t)), lever(arms.a, t, d, n),
                   lever(arms.b, t, d, n), blocks);
  }
}

/// The same where each point has a matrix R of its own, in the container's frame.
struct MatrixLever {
  Triple arm;
  Triple torque[3];             ///< rows of [r]ₓ R
  Columns moment, moment_rows;  ///< torque from linear velocity, Σ [r]ₓ R
};
HWY_INLINE MatrixLever lever(const std::array<Lanes, 3>& arms, const Triple (&r)[3]) {
  MatrixLever l;
  l.arm = Triple::load(arms);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    l.torque[i] = l.arm.at[j] * r[k] - l.arm.at[k] * r[j];
    l.moment_rows.of[i] = totals(l.torque[i]);
  }
  for (std::size_t c = 0; c < 3; ++c) l.moment.of[c] = totals(l.torque[0].at[c], l.torque[1].at[c], l.torque[2].at[c]);
  return l;
}

/// Torque from angular velocity, Σ [p]ₓ R [q]ₓᵀ: its row i is q × row i of [p]ₓ R.
template <bool kTransposed>
HWY_INLINE Columns turning(const MatrixLever& p, const MatrixLever& q) {
  const Triple row[3] = {cross(q.arm, p.torque[0]), cross(q.arm, p.torque[1]), cross(q.arm, p.torque[2])};
  Columns out;
  for (std::size_t k = 0; k < 3; ++k)
    out.of[k] = kTransposed ? totals(row[k]) : totals(row[0].at[k], row[1].at[k], row[2].at[k]);
  return out;
}

HWY_ATTR void add_resistance_kernel(const ContactConstraint* constraints, const ConstraintMatrix* resistance,
                                    std::size_t count, const ContactBlocks& blocks) {
  for (std::size_t p = 0; p < count; ++p) {
    const ContactConstraint& constraint = constraints[p];
    const auto& directions = constraint.directions;
    const auto& own = resistance[p].entry;
    const auto along = [&](std::size_t i) HWY_ATTR {
      return Triple{{Four::all(directions[0][i]), Four::all(directions[1][i]), Four::all(directions[2][i])}};
    };
    const Triple rows[3] = {Triple::load(own[0]), Triple::load(own[1]), Triple::load(own[2])};
    Triple r[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const Triple from = along(i);
      const Triple half = from.at[0] * rows[0] + from.at[1] * rows[1] + from.at[2] * rows[2];
      for (std::size_t j = 0; j < 3; ++j) r[i].at[j] = dot(half, along(j));
    }
    Columns linear;
    for (std::size_t c = 0; c < 3; ++c) linear.of[c] = totals(r[0].at[c], r[1].at[c], r[2].at[c]);
    add_constraint(constraint, blocks.constraint_pair[p], linear, lever(constraint.arms.a, r),
                   lever(constraint.arms.b, r), blocks);
  }
}

/// out −= m sᵀ.
HWY_INLINE void subtract_product(const BodyBlock& m, const BodyBlock& s, BodyBlock& out) {
  Eight column[kBodyRows];
  for (int k = 0; k < kBodyRows; ++k) column[k] = Eight::load(m.column[k]);
  for (int c = 0; c < kBodyRows; ++c) {
    Eight sum = column[0] * Eight::all(s.column[0][padded_row(c)]);
    for (int k = 1; k < kBodyRows; ++k) sum = sum + column[k] * Eight::all(s.column[k][padded_row(c)]);
    (Eight::load(out.column[c]) - sum).store(out.column[c]);
  }
}

/// scaled = m l⁻ᵀ, then m = scaled d⁻¹.
HWY_INLINE void divide(const DiagonalFactor& factor, BodyBlock& m, BodyBlock& scaled) {
  Eight column[kBodyRows];
  for (int k = 0; k < kBodyRows; ++k) column[k] = Eight::load(m.column[k]);
  for (int c = 0; c < kBodyRows; ++c) {
    Eight sum = column[c];
    for (int k = 0; k < c; ++k) sum = sum + column[k] * Eight::all(factor.lower.column[k][padded_row(c)]);
    sum.store(scaled.column[c]);
    (sum * Eight::all(factor.inverse_d.row[padded_row(c)])).store(m.column[c]);
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
    d[j] = block.column[j][padded_row(j)];
    for (int k = 0; k < j; ++k) {
      scaled[k] = l[j][k] * d[k];
      d[j] -= l[j][k] * scaled[k];
    }
    const double inverse_d = factor.inverse_d.row[padded_row(j)] = 1.0 / d[j];
    for (int i = j + 1; i < kBodyRows; ++i) {
      double sum = block.column[j][padded_row(i)];
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
    for (int i = c; i < kBodyRows; ++i)
      factor.lower.column[c][padded_row(i)] = factor.upper.column[i][padded_row(c)] = x[i];
  }
}

HWY_ATTR void factorise_kernel(const LdltStructure& shape, BodyBlock* below, BodyBlock* diagonal,
                               DiagonalFactor* factor, BodyBlock* scratch, std::uint32_t* block_at_row) {
  const std::size_t columns = shape.column_begin.size() - 1;
  for (std::size_t j = 0; j < columns; ++j) {
    factorise(diagonal[j], factor[j]);
    const std::size_t begin = shape.column_begin[j];
    const std::size_t end = shape.column_begin[j + 1];
    for (std::size_t i = begin; i < end; ++i) divide(factor[j], below[i], scratch[i - begin]);
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t column = shape.block_row[k];
      subtract_product(below[k], scratch[k - begin], diagonal[column]);
      if (k + 1 == end) break;
      for (std::uint32_t i = shape.column_begin[column]; i < shape.column_begin[column + 1]; ++i)
        block_at_row[shape.block_row[i]] = i;
      for (std::size_t i = k + 1; i < end; ++i)
        subtract_product(below[i], scratch[k - begin], below[block_at_row[shape.block_row[i]]]);
    }
  }
}

/// A vector whose components are wanted one by one: each fills all rows.
struct Components {
  Eight of[kBodyRows];

  static HWY_INLINE Components load(const double* from) {
    Components c;
    for (int k = 0; k < kBodyRows; ++k) c.of[k] = Eight::all(from[padded_row(k)]);
    return c;
  }
  static HWY_INLINE Components of_rows(const Eight& x) {
    // Not where it is kept: then the compiler would load it again after each store to another body.
    alignas(64) double row[kPaddedRows];
    x.store(row);
    return load(row);
  }
};

/// m x.
HWY_INLINE Eight product(const BodyBlock& m, const Components& x) {
  Eight sum = Eight::load(m.column[0]) * x.of[0];
  for (int k = 1; k < kBodyRows; ++k) sum = sum + Eight::load(m.column[k]) * x.of[k];
  return sum;
}

HWY_ATTR void solve_kernel(const LdltStructure& shape, const BodyBlock* below, const DiagonalFactor* factor,
                           BodyVector* x) {
  const std::size_t columns = shape.column_begin.size() - 1;
  for (std::size_t j = 0; j < columns; ++j) {
    const Eight own = product(factor[j].lower, Components::load(x[j].row));
    const Components components = Components::of_rows(own);
    for (std::size_t i = shape.column_begin[j]; i < shape.column_begin[j + 1]; ++i) {
      double* target = x[shape.block_row[i]].row;
      (Eight::load(target) - product(below[i], components)).store(target);
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
        x[j].row[padded_row(k)] -= ((lane[0] + lane[1]) + (lane[2] + lane[4])) + (lane[5] + lane[6]);
      }
    }
    product(factor[j].upper, Components::load(x[j].row)).store(x[j].row);
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
               std::span<DiagonalFactor> factor, std::span<BodyBlock> scratch, std::span<std::uint32_t> block_at_row) {
  HWY_DYNAMIC_DISPATCH(factorise_kernel)
  (shape, below.data(), diagonal.data(), factor.data(), scratch.data(), block_at_row.data());
}

void solve(const LdltStructure& shape, std::span<const BodyBlock> below, std::span<const DiagonalFactor> factor,
           std::span<BodyVector> x) {
  HWY_DYNAMIC_DISPATCH(solve_kernel)(shape, below.data(), factor.data(), x.data());
}

}  // namespace holdfast::internal::native
#endif  // HWY_ONCE
