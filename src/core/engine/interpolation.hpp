#pragma once

#include "core/base/vector.hpp"

namespace holdfast::internal {

/// Linear between `a` and `b`; exactly `b` at share 1, so that samples at step ends are the states themselves.
Vec3 between(const Vec3& a, const Vec3& b, double share);

/// Normalised linear interpolation along the shorter arc: for the small turn of one step as good as along the
/// great circle, and without trigonometric functions.
Rotation between(const Rotation& a, const Rotation& b, double share);

}  // namespace holdfast::internal
