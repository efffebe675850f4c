#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/vector.hpp"

namespace holdfast::internal::plain {

/// A body in the solver. A fixed body has zero inverse mass and zero inverse inertia.
struct Mover {
  double inverse_mass = 0.0;                                  ///< 1/kg
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero();  ///< about the centre of mass, container frame, 1/(kg m²)
  Vec3 velocity = Vec3::Zero();                               ///< of the centre of mass, m/s
  Vec3 angular_velocity = Vec3::Zero();                       ///< rad/s
};

/// The contact law at one point after a step: u_n >= least, y_n >= 0, and at least one of both with equality
/// (Signorini's condition on velocities: Moreau 1988); |y_t| <= mu y_n, and where the contact slides, y_t is at this
/// limit and opposite to u_t (Coulomb's law with a circular cone). u is the velocity of b relative to a, y the impulse
/// on b.
struct PointLaw {
  std::size_t a = 0;           ///< index of the mover
  std::size_t b = 0;           ///< index of the mover that the normal points to
  Vec3 arm_a = Vec3::Zero();   ///< from a's centre of mass to the point, m
  Vec3 arm_b = Vec3::Zero();   ///< from b's centre of mass to the point, m
  Vec3 normal = Vec3::Zero();  ///< unit, from a to b
  double least = 0.0;          ///< smallest u_n, m/s
  double friction = 0.0;       ///< mu
};

/// The solution.
struct Solution {
  std::vector<Vec3> impulses;  ///< on b, one per point, container frame, N s
  std::uint64_t sweeps = 0;
  double residual = 0.0;  ///< largest change of a point's velocity in the last sweep, m/s
};

/// Velocity of b relative to a at the contact point, m/s.
Vec3 relative_velocity(const std::vector<Mover>& movers, const PointLaw& law);

/// Changes the velocities of `movers` by impulses so that every contact law holds: projected Gauss-Seidel (Jean 1999),
/// point by point, first the normal impulse, then the tangential one. It starts from zero impulses, so that the
/// solution depends only on the arguments, and ends when a sweep changes no point's velocity by more than `tolerance`,
/// m/s, or after `most_sweeps`. A point between two fixed bodies is skipped.
Solution solve(std::vector<Mover>& movers, const std::vector<PointLaw>& laws, double tolerance,
               std::uint64_t most_sweeps);

}  // namespace holdfast::internal::plain
