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

/// What friction can do to the block, m/s².
struct FrictionDeceleration {
  FrictionDeceleration(double both) : at_rest(both), sliding(both) {}  // NOLINT(google-explicit-constructor)
  FrictionDeceleration(double held, double kinetic) : at_rest(held), sliding(kinetic) {}
  double at_rest;  ///< largest acceleration that it holds the block against, μ_s g
  double sliding;  ///< what it slows the sliding block by, μ_k g; not larger
};

/// State of the block at the end of the acceleration. Exact except for rounding: in each interval it sticks, or slides
/// with v' = −a − μg sign(v) (with −a + μg sign(a) when it starts from rest) until it stops.
SlidingBlock slide_along_x(const Acceleration& acceleration, const FrictionDeceleration& friction);

}  // namespace holdfast::internal
