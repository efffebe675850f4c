#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/vector.hpp"

namespace holdfast::internal::plain {

/// A body as the solver sees it. One that nothing moves has no inverse mass and no inverse inertia.
struct Mover {
  double inverse_mass = 0.0;                                  ///< 1/kg
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();  ///< about the centre of mass, container frame, 1/(kg m²)
  Vec3 velocity = Vec3::Zero();                               ///< of the centre of mass, m/s
  Vec3 angular_velocity = Vec3::Zero();                       ///< rad/s
};

/// What holds at one contact point after a step: u_n >= least, y_n >= 0, and one of both equal (Signorini's law on
/// velocities: Moreau 1988); |y_t| <= mu y_n, and where it slips y_t is at its limit against u_t (Coulomb's law with
/// its circular cone). u is the velocity of b relative to a, y the impulse on b.
struct PointLaw {
  std::size_t a = 0;           ///< index of the mover
  std::size_t b = 0;           ///< index of the mover that the normal points to
  Vec3 arm_a = Vec3::Zero();   ///< from a's centre of mass to the point, m
  Vec3 arm_b = Vec3::Zero();   ///< from b's centre of mass to the point, m
  Vec3 normal = Vec3::Zero();  ///< unit, from a to b
  double least = 0.0;          ///< smallest u_n, m/s
  double friction = 0.0;       ///< mu
};

/// What the solver found.
struct Solution {
  std::vector<Vec3> impulses;  ///< on b, a point each, container frame, N s
  std::uint64_t sweeps = 0;
  double residual = 0.0;  ///< largest change of a point's velocity in the last sweep, m/s
};

/// Velocity of b relative to a at the law's point, m/s.
Vec3 relative_velocity(const std::vector<Mover>& movers, const PointLaw& law);

/// Changes the velocities of `movers` by impulses so that every law holds: projected Gauss-Seidel (Jean 1999), point
/// by point, the normal impulse first, then the tangential one. Starts from no impulses, so that the answer depends
/// on its arguments alone, and ends when a sweep changes no point's velocity by more than `tolerance`, m/s, or after
/// `most_sweeps`. A point between two bodies that nothing moves is left alone.
Solution solve(std::vector<Mover>& movers, const std::vector<PointLaw>& laws, double tolerance,
               std::uint64_t most_sweeps);

}  // namespace holdfast::internal::plain
