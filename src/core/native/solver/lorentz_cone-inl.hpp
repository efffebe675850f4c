// The Lorentz cone x₀ ≥ |(x₁, x₂)|, four vectors at a time, with the product that makes it a symmetric cone, its unit
// being (1, 0, 0). See L. Vandenberghe, "The CVXOPT linear and quadratic cone program solvers", 2010, whose formulas
// these are.

// Highway has each instruction set include this file again.
#if defined(HOLDFAST_LORENTZ_CONE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HOLDFAST_LORENTZ_CONE_INL
#undef HOLDFAST_LORENTZ_CONE_INL
#else
#define HOLDFAST_LORENTZ_CONE_INL
#endif

#include <hwy/highway.h>
#include <limits>

#include "core/native/solver/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace holdfast::internal::native::HWY_NAMESPACE::lorentz {

/// x where the condition holds, else `otherwise`.
HWY_INLINE Four if_positive(const Four& condition, const Four& x, const Four& otherwise) {
  Four p;
  for (std::size_t i = 0; i < Four::kVectors; ++i) {
    const auto positive = hn::Gt(condition.part[i], hn::Zero(Four::D()));
    p.part[i] = hn::IfThenElse(positive, x.part[i], otherwise.part[i]);
  }
  return p;
}

/// x with the sign of y.
HWY_INLINE Four copy_sign(const Four& x, const Four& y) {
  return Four::map(x, y, [](auto a, auto b) HWY_ATTR { return hn::CopySign(a, b); });
}

/// a where it is not a number, else b.
HWY_INLINE Four if_nan(const Four& a, const Four& b) {
  return Four::map(a, b, [](auto x, auto y) HWY_ATTR { return hn::IfThenElse(hn::IsNaN(x), x, y); });
}

HWY_INLINE Four tangential_length(const Triple& x) { return (x.at[1] * x.at[1] + x.at[2] * x.at[2]).sqrt(); }

/// x₀² − |(x₁, x₂)|², positive inside; as a product it is never negative there by rounding.
HWY_INLINE Four determinant(const Triple& x) {
  const Four t = tangential_length(x);
  return (x.at[0] - t) * (x.at[0] + t);
}

HWY_INLINE Triple reflected(const Triple& x) { return {{x.at[0], Four::all(0.0) - x.at[1], Four::all(0.0) - x.at[2]}}; }

/// a ∘ b.
HWY_INLINE Triple product(const Triple& a, const Triple& b) {
  return {{dot(a, b), a.at[0] * b.at[1] + b.at[0] * a.at[1], a.at[0] * b.at[2] + b.at[0] * a.at[2]}};
}

/// The x with a ∘ x = b, of an a inside the cone.
HWY_INLINE Triple quotient(const Triple& b, const Triple& a) {
  const Four x = (a.at[0] * b.at[0] - a.at[1] * b.at[1] - a.at[2] * b.at[2]) / determinant(a);
  const Four over_a = Four::all(1.0) / a.at[0];
  return {{x, over_a * (b.at[1] - x * a.at[1]), over_a * (b.at[2] - x * a.at[2])}};
}

/// The largest α with x + α d in the cone, of an x inside. Not a number where d is none.
HWY_INLINE Four longest_step(const Triple& x, const Triple& d) {
  const Four infinity = Four::all(std::numeric_limits<double>::infinity());
  const Four descent = Four::all(0.0) - d.at[0];
  Four longest = if_positive(descent, x.at[0] / descent, infinity);
  // Where the determinant a α² + 2 b α + c is 0. Without roots the square root is no number, nor what follows from it.
  const Four a = d.at[0] * d.at[0] - d.at[1] * d.at[1] - d.at[2] * d.at[2];
  const Four b = x.at[0] * d.at[0] - x.at[1] * d.at[1] - x.at[2] * d.at[2];
  const Four c = determinant(x);
  const Four discriminant = b * b - a * c;
  const Four q = Four::all(0.0) - (b + copy_sign(discriminant.sqrt(), b));
  for (const Four& root : {q / a, c / q}) longest = min(longest, if_positive(root, root, infinity));
  return if_nan(discriminant, longest);
}

/// The scaling W of Nesterov and Todd (1997), symmetric, with W² y = s, as W = η W̄. W̄ has determinant 1; η² alone is
/// used, since a root of it would not scale exactly when all masses are scaled by 2.
struct Scaling {
  Four square;  ///< η²
  Triple w;

  static HWY_INLINE Scaling of(const Triple& y, const Triple& s) {
    const Four one = Four::all(1.0);
    const Four half = Four::all(0.5);
    const Four y_root = determinant(y).sqrt();
    const Four s_root = determinant(s).sqrt();
    const Four over_y = one / y_root;
    const Four over_s = one / s_root;
    // Both have determinant 1, and so has half of their sum over this root.
    const Four root = (half * (one + dot(y, s) * over_y * over_s)).sqrt();
    return {s_root / y_root, half / root * (over_s * s + over_y * reflected(y))};
  }

  /// W̄ x.
  HWY_INLINE Triple scaled(const Triple& x) const {
    const Four along = w.at[1] * x.at[1] + w.at[2] * x.at[2];
    const Four share = x.at[0] + along * over_sum();
    return {{w.at[0] * x.at[0] + along, x.at[1] + share * w.at[1], x.at[2] + share * w.at[2]}};
  }

  /// W̄⁻¹ x.
  HWY_INLINE Triple unscaled(const Triple& x) const {
    const Four along = w.at[1] * x.at[1] + w.at[2] * x.at[2];
    const Four share = along * over_sum() - x.at[0];
    return {{w.at[0] * x.at[0] - along, x.at[1] + share * w.at[1], x.at[2] + share * w.at[2]}};
  }

  /// 1 / (1 + w₀): one division, however often it is asked for.
  HWY_INLINE Four over_sum() const { return Four::all(1.0) / (Four::all(1.0) + w.at[0]); }

  /// W⁻² = (2 r rᵀ + diag(−1, 1, 1)) / η², r the reflected w.
  HWY_INLINE void inverse_square(Four (&out)[3][3]) const {
    const Four one = Four::all(1.0);
    const Four over_square = one / square;
    const Triple r = reflected(w);
    const Triple twice = Four::all(2.0) * r;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < i; ++j) out[i][j] = out[j][i] = twice.at[i] * r.at[j] * over_square;
      const Four own = twice.at[i] * r.at[i];
      out[i][i] = (i == 0 ? own - one : own + one) * over_square;
    }
  }
};

}  // namespace holdfast::internal::native::HWY_NAMESPACE::lorentz
HWY_AFTER_NAMESPACE();

#endif  // HOLDFAST_LORENTZ_CONE_INL
