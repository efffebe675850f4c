// The arithmetic of the contact solver, once for every instruction set, chosen at run time. All operations are
// element by element, sums over lanes have a fixed order, and nothing is fused or estimated: the bits are the same
// on every instruction set.
#include "core/native/kernels.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/native/kernels.cpp"
// Vectors are kept in arrays, which scalable ones cannot be.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace holdfast::native::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// A fixed number of doubles, however many vectors they take.
template <std::size_t kSize>
struct Pack {
  using D = hn::CappedTag<double, kSize>;
  static constexpr std::size_t kWidth = hn::MaxLanes(D());
  static constexpr std::size_t kVectors = kSize / kWidth;
  hn::Vec<D> part[kVectors];

  static HWY_INLINE Pack load(const double* from) {
    Pack p;
    for (std::size_t i = 0; i < kVectors; ++i) p.part[i] = hn::Load(D(), from + i * kWidth);
    return p;
  }
  static HWY_INLINE Pack all(double value) {
    Pack p;
    for (std::size_t i = 0; i < kVectors; ++i) p.part[i] = hn::Set(D(), value);
    return p;
  }
  HWY_INLINE void store(double* to) const {
    for (std::size_t i = 0; i < kVectors; ++i) hn::Store(part[i], D(), to + i * kWidth);
  }

  template <class Operation>
  static HWY_INLINE Pack map(const Pack& a, const Pack& b, Operation operation) {
    Pack p;
    for (std::size_t i = 0; i < kVectors; ++i) p.part[i] = operation(a.part[i], b.part[i]);
    return p;
  }
  friend HWY_INLINE Pack operator+(const Pack& a, const Pack& b) {
    return map(a, b, [](auto x, auto y) HWY_ATTR { return hn::Add(x, y); });
  }
  friend HWY_INLINE Pack operator-(const Pack& a, const Pack& b) {
    return map(a, b, [](auto x, auto y) HWY_ATTR { return hn::Sub(x, y); });
  }
  friend HWY_INLINE Pack operator*(const Pack& a, const Pack& b) {
    return map(a, b, [](auto x, auto y) HWY_ATTR { return hn::Mul(x, y); });
  }
  friend HWY_INLINE Pack max(const Pack& a, const Pack& b) {
    return map(a, b, [](auto x, auto y) HWY_ATTR { return hn::Max(x, y); });
  }
  HWY_INLINE Pack abs() const {
    Pack p;
    for (std::size_t i = 0; i < kVectors; ++i) p.part[i] = hn::Abs(part[i]);
    return p;
  }
};

using Four = Pack<kLanes>;
using Eight = Pack<kPaddedRows>;

/// limit / √square where that shortens, else 1.
HWY_INLINE Four shrink(const Four& limit, const Four& square) {
  Four p;
  const Four::D d;
  for (std::size_t i = 0; i < Four::kVectors; ++i) {
    const auto beyond = hn::Gt(square.part[i], hn::Mul(limit.part[i], limit.part[i]));
    // The square is positive wherever it is beyond the limit; elsewhere 1 keeps 0/0 out.
    const auto safe = hn::IfThenElse(beyond, square.part[i], hn::Set(d, 1.0));
    p.part[i] = hn::IfThenElse(beyond, hn::Div(limit.part[i], hn::Sqrt(safe)), hn::Set(d, 1.0));
  }
  return p;
}

/// Velocity of b's surface relative to a's at the points, container frame.
struct Relative {
  Four x, y, z;
};
HWY_INLINE Relative relative_velocity(const Arms& arms, const double* va, const double* vb) {
  const auto arm = [](const std::array<Lanes, 3>& from, int i)
                       HWY_ATTR { return Four::load(from[static_cast<std::size_t>(i)].data()); };
  const Four ax = arm(arms.a, 0), ay = arm(arms.a, 1), az = arm(arms.a, 2);
  const Four bx = arm(arms.b, 0), by = arm(arms.b, 1), bz = arm(arms.b, 2);
  const Four wax = Four::all(va[3]), way = Four::all(va[4]), waz = Four::all(va[5]);
  const Four wbx = Four::all(vb[3]), wby = Four::all(vb[4]), wbz = Four::all(vb[5]);
  return {Four::all(vb[0] - va[0]) + (wby * bz - wbz * by) - (way * az - waz * ay),
          Four::all(vb[1] - va[1]) + (wbz * bx - wbx * bz) - (waz * ax - wax * az),
          Four::all(vb[2] - va[2]) + (wbx * by - wby * bx) - (wax * ay - way * ax)};
}

HWY_INLINE Four along(const Relative& v, const std::array<double, 3>& direction) {
  return Four::all(direction[0]) * v.x + Four::all(direction[1]) * v.y + Four::all(direction[2]) * v.z;
}

/// Adds the wrench of the forces `f` (along the patch's directions, on b) to b, and its opposite to a.
HWY_INLINE void add_wrench(const Patch& patch, const Arms& arms, const Four (&f)[3], LaneWrench* wrench) {
  Four force[3];
  for (std::size_t i = 0; i < 3; ++i) {
    force[i] = Four::all(patch.directions[0][i]) * f[0] + Four::all(patch.directions[1][i]) * f[1] +
               Four::all(patch.directions[2][i]) * f[2];
  }
  LaneWrench& on_a = wrench[patch.a];
  LaneWrench& on_b = wrench[patch.b];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    (Four::load(on_a.row[i]) - force[i]).store(on_a.row[i]);
    (Four::load(on_b.row[i]) + force[i]).store(on_b.row[i]);
    const Four torque_a = Four::load(arms.a[j].data()) * force[k] - Four::load(arms.a[k].data()) * force[j];
    const Four torque_b = Four::load(arms.b[j].data()) * force[k] - Four::load(arms.b[k].data()) * force[j];
    (Four::load(on_a.row[3 + i]) - torque_a).store(on_a.row[3 + i]);
    (Four::load(on_b.row[3 + i]) + torque_b).store(on_b.row[3 + i]);
  }
}

HWY_INLINE Four load(const PatchVector& from, std::size_t row) { return Four::load(from.row[row].data()); }

/// Sum over the lanes.
HWY_INLINE double total(const Four& four) {
  alignas(64) double lane[kLanes];
  four.store(lane);
  return (lane[0] + lane[1]) + (lane[2] + lane[3]);
}

/// The largest of the lanes.
HWY_INLINE double largest(const Four& four) {
  alignas(64) double lane[kLanes];
  four.store(lane);
  return std::max(std::max(lane[0], lane[1]), std::max(lane[2], lane[3]));
}

HWY_ATTR double aim_kernel(const Patch* patches, std::size_t count, const BodyVector* velocity, double relaxation,
                           PatchVector* out_u, PatchVector* out_g, PatchVector* out_r) {
  const Four alpha = Four::all(relaxation);
  Four worst = Four::all(0.0);
  for (std::size_t p = 0; p < count; ++p) {
    const Patch& patch = patches[p];
    const Relative v = relative_velocity(patch.arms, velocity[patch.a].row, velocity[patch.b].row);
    const Four resistance[2] = {Four::load(patch.resistance[0].data()), Four::load(patch.resistance[1].data())};
    const Four compliance[2] = {Four::load(patch.compliance[0].data()), Four::load(patch.compliance[1].data())};
    for (std::size_t i = 0; i < 3; ++i) {
      const Four u = along(v, patch.directions[i]) + load(patch.allowance, i);
      const Four z = load(patch.slip, i);
      const Four mismatch = u - z;
      const Four r = Four::all(0.0) - alpha * (resistance[i > 0] * mismatch);
      u.store(out_u[p].row[i].data());
      r.store(out_r[p].row[i].data());
      (load(patch.impulse, i) - resistance[i > 0] * z + r).store(out_g[p].row[i].data());
      // A lane without a point has no slip to compare with.
      worst = max(worst, (mismatch * (compliance[i > 0] * resistance[i > 0])).abs());
    }
  }
  return largest(worst);
}

HWY_ATTR void project_kernel(Patch* patches, const Arms* mid_arms, std::size_t count, const PatchVector* in_x,
                             const PatchVector* in_u, LaneWrench* wrench) {
  for (std::size_t p = 0; p < count; ++p) {
    Patch& patch = patches[p];
    const Four x[3] = {load(in_x[p], 0), load(in_x[p], 1), load(in_x[p], 2)};
    // The exact law: the normal part is cut at zero, the tangential part at the disc it allows (no dilation).
    const Four normal = max(x[0], Four::all(0.0));
    const Four share = shrink(Four::all(patch.friction) * normal, x[1] * x[1] + x[2] * x[2]);
    const Four y[3] = {normal, x[1] * share, x[2] * share};
    Four f[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const Four z = (y[i] - x[i]) * Four::load(patch.compliance[i > 0].data());
      y[i].store(patch.impulse.row[i].data());
      z.store(patch.slip.row[i].data());
      f[i] = y[i] + Four::load(patch.resistance[i > 0].data()) * (z - load(in_u[p], i));
    }
    add_wrench(patch, mid_arms == nullptr ? patch.arms : mid_arms[p], f, wrench);
  }
}

HWY_ATTR double dot_kernel(const Patch* patches, std::size_t count, const PatchVector* a, const PatchVector* b) {
  Four sum[3] = {Four::all(0.0), Four::all(0.0), Four::all(0.0)};
  for (std::size_t p = 0; p < count; ++p)
    for (std::size_t i = 0; i < 3; ++i)
      sum[i] = sum[i] + load(a[p], i) * load(b[p], i) * Four::load(patches[p].compliance[i > 0].data());
  return total(sum[0] + (sum[1] + sum[2]));
}

HWY_ATTR void take_difference_kernel(std::size_t count, const PatchVector* now, PatchVector* last, PatchVector* step) {
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Four x = load(now[p], i);
      (x - load(last[p], i)).store(step[p].row[i].data());
      x.store(last[p].row[i].data());
    }
  }
}

HWY_ATTR void subtract_kernel(std::size_t count, const std::vector<PatchVector>* history, const double* weight,
                              std::size_t depth, PatchVector* x) {
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      Four sum = load(x[p], i);
      for (std::size_t k = 0; k < depth; ++k) sum = sum - Four::all(weight[k]) * load(history[k].data()[p], i);
      sum.store(x[p].row[i].data());
    }
  }
}

HWY_ATTR void add_impulses_kernel(const Patch* patches, const Arms* mid_arms, std::size_t count, LaneWrench* wrench) {
  for (std::size_t p = 0; p < count; ++p) {
    const Patch& patch = patches[p];
    const Four y[3] = {load(patch.impulse, 0), load(patch.impulse, 1), load(patch.impulse, 2)};
    add_wrench(patch, mid_arms == nullptr ? patch.arms : mid_arms[p], y, wrench);
  }
}

/// Three components of a vector at the points of a patch.
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

/// How a patch's points, each at arm r with R = t I + d n nᵀ, resist when a body turns.
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

HWY_ATTR void add_resistance_kernel(const Patch* patches, const Arms* mid_arms, std::size_t count,
                                    const std::uint32_t* patch_pair, const std::uint32_t* pair_block,
                                    std::int32_t fixed, BodyBlock* diagonal, BodyBlock* below) {
  for (std::size_t p = 0; p < count; ++p) {
    const Patch& patch = patches[p];
    const Arms& arms = mid_arms == nullptr ? patch.arms : mid_arms[p];
    const std::array<double, 3>& n = patch.directions[0];
    const Four t = Four::load(patch.resistance[1].data());
    const Four d = Four::load(patch.resistance[0].data()) - t;
    const double sum_t = total(t);
    const double sum_d = total(d);
    double linear[3][3];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) linear[i][j] = sum_d * n[i] * n[j] + (i == j ? sum_t : 0.0);
    double turning[3][3];
    const Lever a = lever(arms.a, t, d, n);
    const Lever b = lever(arms.b, t, d, n);
    if (patch.a != fixed) {
      add_turning(a, a, turning);
      add_block(1.0, linear, a.moment, a.moment, turning, false, diagonal[patch.a]);
    }
    if (patch.b != fixed) {
      add_turning(b, b, turning);
      add_block(1.0, linear, b.moment, b.moment, turning, false, diagonal[patch.b]);
    }
    if (patch_pair[p] == kNoPair) continue;
    BodyBlock& block = below[pair_block[patch_pair[p]]];
    add_turning(a, b, turning);
    if (patch.a > patch.b)
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

HWY_ATTR void factorise_kernel(const FactorShape& shape, BodyBlock* below, BodyBlock* diagonal, BodyBlock* scratch) {
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

HWY_ATTR void solve_kernel(const FactorShape& shape, const BodyBlock* below, const BodyBlock* inverse_diagonal,
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
}  // namespace holdfast::native::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace holdfast::native {

HWY_EXPORT(aim_kernel);
HWY_EXPORT(project_kernel);
HWY_EXPORT(dot_kernel);
HWY_EXPORT(take_difference_kernel);
HWY_EXPORT(subtract_kernel);
HWY_EXPORT(add_impulses_kernel);
HWY_EXPORT(add_resistance_kernel);
HWY_EXPORT(factorise_kernel);
HWY_EXPORT(solve_kernel);

namespace {

const Arms* arms_or_null(std::span<const Arms> arms) { return arms.empty() ? nullptr : arms.data(); }

}  // namespace

double aim(std::span<const Patch> patches, std::span<const BodyVector> velocity, double relaxation,
           std::span<PatchVector> u, std::span<PatchVector> g, std::span<PatchVector> r) {
  return HWY_DYNAMIC_DISPATCH(aim_kernel)(patches.data(), patches.size(), velocity.data(), relaxation, u.data(),
                                          g.data(), r.data());
}

void project(std::span<Patch> patches, std::span<const Arms> mid_arms, std::span<const PatchVector> x,
             std::span<const PatchVector> u, std::span<LaneWrench> wrench) {
  HWY_DYNAMIC_DISPATCH(project_kernel)
  (patches.data(), arms_or_null(mid_arms), patches.size(), x.data(), u.data(), wrench.data());
}

double dot(std::span<const Patch> patches, std::span<const PatchVector> a, std::span<const PatchVector> b) {
  return HWY_DYNAMIC_DISPATCH(dot_kernel)(patches.data(), patches.size(), a.data(), b.data());
}

void take_difference(std::span<const PatchVector> now, std::span<PatchVector> last, std::span<PatchVector> step) {
  HWY_DYNAMIC_DISPATCH(take_difference_kernel)(now.size(), now.data(), last.data(), step.data());
}

void subtract(std::span<const std::vector<PatchVector>> history, std::span<const double> weight,
              std::span<PatchVector> x) {
  HWY_DYNAMIC_DISPATCH(subtract_kernel)(x.size(), history.data(), weight.data(), weight.size(), x.data());
}

void add_impulses(std::span<const Patch> patches, std::span<const Arms> mid_arms, std::span<LaneWrench> wrench) {
  HWY_DYNAMIC_DISPATCH(add_impulses_kernel)(patches.data(), arms_or_null(mid_arms), patches.size(), wrench.data());
}

void add_resistance(std::span<const Patch> patches, std::span<const Arms> mid_arms,
                    std::span<const std::uint32_t> patch_pair, std::span<const std::uint32_t> pair_block,
                    std::span<BodyBlock> diagonal, std::span<BodyBlock> below) {
  HWY_DYNAMIC_DISPATCH(add_resistance_kernel)
  (patches.data(), arms_or_null(mid_arms), patches.size(), patch_pair.data(), pair_block.data(),
   static_cast<std::int32_t>(diagonal.size()), diagonal.data(), below.data());
}

void factorise(const FactorShape& shape, std::span<BodyBlock> below, std::span<BodyBlock> diagonal,
               std::span<BodyBlock> scratch) {
  HWY_DYNAMIC_DISPATCH(factorise_kernel)(shape, below.data(), diagonal.data(), scratch.data());
}

void solve(const FactorShape& shape, std::span<const BodyBlock> below, std::span<const BodyBlock> inverse_diagonal,
           std::span<BodyVector> x) {
  HWY_DYNAMIC_DISPATCH(solve_kernel)(shape, below.data(), inverse_diagonal.data(), x.data());
}

std::vector<std::int64_t> instruction_sets() { return hwy::SupportedAndGeneratedTargets(); }

void use_instruction_set(std::int64_t set) { hwy::SetSupportedTargetsForTest(set); }

}  // namespace holdfast::native
#endif  // HWY_ONCE
