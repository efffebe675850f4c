#pragma once

#include "core/base/vector.hpp"
#include "core/model/acceleration.hpp"

namespace holdfast::internal {

/// Exact state of a sliding block at the end of an acceleration.
struct SlidePath {
  Vec3 displacement = Vec3::Zero();  ///< m
  Vec3 velocity = Vec3::Zero();      ///< m/s
  double stop_time = 0.0;            ///< of the last stop, s; 0 when it never moved
  double distance = 0.0;             ///< length of the path, m; only of `slide_along`
};

/// A block on a floor under an acceleration of the container along one line, x or y, and any acceleration along z that
/// does not lift it. Exact, by the closed formulas between its starts and stops:
///   at rest: starts when |a| > μ (g + a_z), with |a| − k μ (g + a_z) opposite to a
///   sliding: −a − k μ (g + a_z) sign(v), until it stops
/// @param friction coefficient μ at rest
/// @param velocity at the start, along the axis, m/s
/// @param kinetic_share k, of the coefficient while it slides in that at rest, at most 1
SlidePath slide_along(int axis, const Acceleration& acceleration, double friction, double gravity,
                      double velocity = 0.0, double kinetic_share = 1.0);

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
  double kinetic_share = 1.0;   ///< of the coefficients while they slide in the two above, at most 1
};
struct StackedPaths {
  double lower = 0.0;  ///< displacement along x, m
  double upper = 0.0;  ///< displacement along x, m
  double lower_velocity = 0.0;
  double upper_velocity = 0.0;
};

/// Both blocks from rest to the end of an acceleration along x. Exact, by the closed formulas between the times at
/// which a contact starts or stops sliding. With a kinetic share below 1, an acceleration that breaks both contacts at
/// once has more than one answer: here the upper one breaks only if it cannot follow the lower block, which has kinetic
/// friction already.
StackedPaths slide_stacked(const Acceleration& acceleration, const StackedBlocks& blocks);

}  // namespace holdfast::internal
