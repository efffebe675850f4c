#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/native/collision/oriented_box.hpp"

namespace holdfast::internal::native {

/// The Lorentz cone x₀ ≥ |(x₁, x₂)| with the product that makes it a symmetric cone, its unit being (1, 0, 0). See L.
/// Vandenberghe, "The CVXOPT linear and quadratic cone program solvers", 2010, whose formulas these are.
namespace lorentz {

inline double tangential_length(const Vec3& x) { return std::sqrt(x[1] * x[1] + x[2] * x[2]); }

/// x₀² − |(x₁, x₂)|², positive inside; as a product it is never negative there by rounding.
inline double determinant(const Vec3& x) {
  const double t = tangential_length(x);
  return (x[0] - t) * (x[0] + t);
}

inline Vec3 reflected(const Vec3& x) { return {x[0], -x[1], -x[2]}; }

/// a ∘ b.
inline Vec3 product(const Vec3& a, const Vec3& b) {
  return {a.dot(b), a[0] * b[1] + b[0] * a[1], a[0] * b[2] + b[0] * a[2]};
}

/// The x with a ∘ x = b, of an a inside the cone.
inline Vec3 quotient(const Vec3& b, const Vec3& a) {
  const double x = (a[0] * b[0] - a[1] * b[1] - a[2] * b[2]) / determinant(a);
  return {x, (b[1] - x * a[1]) / a[0], (b[2] - x * a[2]) / a[0]};
}

/// The largest α with x + α d in the cone, of an x inside.
inline double longest_step(const Vec3& x, const Vec3& d) {
  double longest = d[0] < 0.0 ? -x[0] / d[0] : std::numeric_limits<double>::infinity();
  // Where the determinant a α² + 2 b α + c is 0.
  const double a = d[0] * d[0] - d[1] * d[1] - d[2] * d[2];
  const double b = x[0] * d[0] - x[1] * d[1] - x[2] * d[2];
  const double c = determinant(x);
  const double discriminant = b * b - a * c;
  if (std::isnan(discriminant)) return discriminant;
  if (discriminant < 0.0) return longest;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  for (const double root : {q / a, c / q})
    if (root > 0.0) longest = std::min(longest, root);
  return longest;
}

/// The scaling W of Nesterov and Todd (1997), symmetric, with W² y = s, as W = η W̄. W̄ has determinant 1; η² alone is
/// used, since a root of it would not scale exactly when all masses are scaled by 2.
struct Scaling {
  double square = 1.0;  ///< η²
  Vec3 w = Vec3::UnitX();

  Scaling() = default;
  Scaling(const Vec3& y, const Vec3& s) {
    const double y_root = std::sqrt(determinant(y));
    const double s_root = std::sqrt(determinant(s));
    square = s_root / y_root;
    const Vec3 sum = s / s_root + reflected(y) / y_root;
    // Both have determinant 1, and so has half of their sum over this root.
    w = sum / (2.0 * std::sqrt(0.5 * (1.0 + y.dot(s) / (y_root * s_root))));
  }

  /// W̄ x.
  Vec3 scaled(const Vec3& x) const {
    const double along = w[1] * x[1] + w[2] * x[2];
    const double share = x[0] + along / (1.0 + w[0]);
    return {w[0] * x[0] + along, x[1] + share * w[1], x[2] + share * w[2]};
  }

  /// W̄⁻¹ x.
  Vec3 unscaled(const Vec3& x) const {
    const double along = w[1] * x[1] + w[2] * x[2];
    const double share = along / (1.0 + w[0]) - x[0];
    return {w[0] * x[0] - along, x[1] + share * w[1], x[2] + share * w[2]};
  }

  /// W⁻².
  Mat3 inverse_square() const {
    const Vec3 r = reflected(w);
    Mat3 matrix = 2.0 * r * r.transpose();
    matrix.diagonal() += Vec3(-1.0, 1.0, 1.0);
    return matrix / square;
  }
};

}  // namespace lorentz

}  // namespace holdfast::internal::native
