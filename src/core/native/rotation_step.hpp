#pragma once

#include <cmath>

#include "core/native/collision/oriented_box.hpp"

namespace holdfast::internal::native {

/// Rotation by a rotation vector, rad. The half angle's tangent is its Padé approximant
/// x (945 − 105 x² + x⁴) / (945 − 420 x² + 15 x⁴), right to 1e-13 below half a radian: the sine and cosine of C
/// libraries differ between versions and processors, and a world's bits may not.
inline Rotation rotation_by(const Vec3& vector) {
  const double x2 = 0.25 * vector.squaredNorm();
  const double tangent_over_x = (945.0 - 105.0 * x2 + x2 * x2) / (945.0 - 420.0 * x2 + 15.0 * x2 * x2);
  const Vec3 imaginary = 0.5 * tangent_over_x * vector;
  const double scale = 1.0 / std::sqrt(1.0 + imaginary.squaredNorm());
  return {scale, scale * imaginary.x(), scale * imaginary.y(), scale * imaginary.z()};
}

/// Turns an orientation by a rotation vector, rad.
inline void rotate(Rotation& orientation, const Vec3& turn) {
  if (turn == Vec3::Zero()) return;
  orientation = (rotation_by(turn) * orientation).normalized();
}

/// Moments of inertia in the container's frame, kg m².
/// @param principal along the body's axes
inline Mat3 inertia_in_container(const Mat3& axes, const Vec3& principal) {
  return axes * principal.asDiagonal() * axes.transpose();
}

/// The vector shortened to `limit` where it is longer.
inline Vec3 clamped(const Vec3& vector, double limit) {
  const double square = vector.squaredNorm();
  return square > limit * limit ? Vec3(vector * (limit / std::sqrt(square))) : vector;
}

}  // namespace holdfast::internal::native
