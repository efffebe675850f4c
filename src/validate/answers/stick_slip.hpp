#pragma once

#include "core/base/vector.hpp"
#include "core/model/acceleration.hpp"

namespace holdfast::internal {

/// Exact state of a sliding block at the end of an acceleration.
struct SlidePath {
  Vec3 displacement = Vec3::Zero();  ///< m
  Vec3 velocity = Vec3::Zero();      ///< m/s
  double stop_time = 0.0;            ///< of the last stop, s; 0 when it never moved
};

/// A block on a floor under an acceleration of the container along one line, x or y, and any acceleration along z that
/// does not lift it. Exact, by the closed formulas between its starts and stops:
///   at rest: starts when |a| > μ (g + a_z), with |a| − μ (g + a_z) opposite to a
///   sliding: −a − μ (g + a_z) sign(v), until it stops
/// @param velocity at the start, along the axis, m/s
SlidePath slide_along(int axis, const Acceleration& acceleration, double friction, double gravity,
                      double velocity = 0.0);

/// A block on a floor under a horizontal acceleration that changes direction: v' = −a − μ g v/|v| by the classical
/// Runge-Kutta method, with steps of 10 µs that end at the breakpoints of the acceleration. Errors below 1e-8 m.
SlidePath slide_over(const Acceleration& acceleration, double friction, double gravity,
                     const Vec3& velocity = Vec3::Zero());

/// A block on a block on the floor, all moving along x.
struct StackedBlocks {
  double lower_mass = 1.0;
  double upper_mass = 1.0;
  double floor_friction = 0.0;
  double upper_friction = 0.0;  ///< between the two
  double gravity = 9.81;        ///< m/s²
};
struct StackedPaths {
  double lower = 0.0;  ///< displacement along x, m
  double upper = 0.0;  ///< displacement along x, m
  double lower_velocity = 0.0;
  double upper_velocity = 0.0;
};

/// Both blocks from rest to the end of an acceleration along x. Exact, by the closed formulas between the times at
/// which a contact starts or stops sliding.
StackedPaths slide_stacked(const Acceleration& acceleration, const StackedBlocks& blocks);

}  // namespace holdfast::internal
