#pragma once

#include "core/model/acceleration.hpp"

namespace holdfast::internal {

/// A body on a floor that moves along x with piecewise constant acceleration; only friction acts on it (Newmark's
/// sliding block). Relative to the floor.
struct SlidingBlock {
  double displacement = 0.0;  ///< m
  double velocity = 0.0;      ///< m/s
  double distance = 0.0;      ///< length of the path, m
};

/// State of the block at the end of the acceleration. Exact except for rounding: in each interval it sticks, or slides
/// with v' = −a − μg sign(v) (with −a + μg sign(a) when it starts from rest) until it stops.
/// @param friction_deceleration μg, m/s²
SlidingBlock slide_along_x(const Acceleration& acceleration, double friction_deceleration);

}  // namespace holdfast::internal
