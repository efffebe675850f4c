#include "core/engine/interpolation.hpp"

namespace holdfast::internal {

Vec3 between(const Vec3& a, const Vec3& b, double share) { return share == 1.0 ? b : Vec3(a + share * (b - a)); }

Rotation between(const Rotation& a, const Rotation& b, double share) {
  if (share == 1.0) return b;
  const double sign = a.coeffs().dot(b.coeffs()) < 0.0 ? -1.0 : 1.0;
  Rotation q;
  q.coeffs() = (1.0 - share) * a.coeffs() + sign * share * b.coeffs();
  q.normalize();
  return q;
}

}  // namespace holdfast::internal
