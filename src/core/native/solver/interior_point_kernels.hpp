#pragma once

#include <cmath>
#include <span>

#include "core/native/solver/contact_constraint.hpp"

// The inner loops of the interior point method, see `InteriorPoint`.

namespace holdfast::internal::native {

/// What the interior point method keeps of a constraint's points. Lorentz coordinates are those of a constraint with
/// the normal part times (impulses) or over (velocities) μ: both cones are then the Lorentz cone. A lane that takes no
/// part stays in the middle of its cone: it has no impulse, no resistance, and no end of a step.
struct alignas(64) InteriorPoints {
  ConstraintVector y = {{{{1, 1, 1, 1}, {}, {}}}}, s = y;     ///< Lorentz coordinates
  Lanes p = {1, 1, 1, 1}, l = {};                             ///< slack and multiplier λ of the bound
  Lanes bound = {};                                           ///< of the normal impulse; 0 where there is none
  Lanes takes_part = {}, has_friction = {}, is_bounded = {};  ///< 1 or 0; the last two only with the first

  // Of an iteration:
  Lanes scaling_square = {};  ///< η² of `lorentz::Scaling`
  ConstraintVector scaling;   ///< w of it
  ConstraintVector drive;     ///< g of Δy = R (g − J Δv), m/s
  ConstraintVector dy, ds;    ///< Lorentz coordinates
  Lanes dp = {}, dl = {};

  double friction = 1.0, inverse_friction = 1.0;  ///< μ and 1/μ; 1 where there is none
};

/// What a Newton step of the interior point method aims at.
struct InteriorTarget {
  double complementarity = 0.0;  ///< of each pair of complementary variables, kg m²/s²
  bool corrects = false;         ///< takes account of what the products of the last step's changes add
};

/// The smaller of two steps; not a number where one of them is none.
inline double shorter(double a, double b) { return a <= b || std::isnan(a) ? a : b; }

/// Finds the scaling and the resistance R = (D W² D + λ/p n nᵀ)⁻¹ of every point, D from Lorentz coordinates of
/// velocities to those of the constraint. Returns the sum of the products of complementary variables, kg m²/s².
double scale(std::span<InteriorPoints> points, std::span<ConstraintMatrix> resistance);

/// Finds the drive g = D W̄ (ℓ⁻¹ ∘ c) + s − J v − λ n − n (c_λ + λ r_p) / p, with ℓ = W̄ y, the right-hand sides c and
/// c_λ of the products' Newton equations, and the residual r_p of the bound. Sets the impulses to y + R g.
/// @param u J v
void find_drive(const InteriorTarget& target, std::span<InteriorPoints> points,
                std::span<const ConstraintMatrix> resistance, std::span<const ConstraintVector> u,
                std::span<ContactConstraint> constraints);

/// Finds the changes of the variables that go with Δv. Returns the largest share of them that stays within all cones;
/// not a number where one of them is none.
/// @param u, du J v, J Δv
double find_changes(const InteriorTarget& target, std::span<InteriorPoints> points,
                    std::span<const ConstraintMatrix> resistance, std::span<const ConstraintVector> u,
                    std::span<const ConstraintVector> du);

/// Goes a share of the changes.
void take_step(double step, std::span<InteriorPoints> points);

/// Sets impulses and contact velocities to y and s.
void write_back(std::span<const InteriorPoints> points, std::span<ContactConstraint> constraints);

}  // namespace holdfast::internal::native
