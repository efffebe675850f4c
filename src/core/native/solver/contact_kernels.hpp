#pragma once

#include <span>
#include <vector>

#include "core/native/solver/body_block.hpp"
#include "core/native/solver/contact_constraint.hpp"

// The inner loops over contacts.

namespace holdfast::internal::native {

/// Difference between the velocities at the points and those that go with the impulses, |u − z|.
struct PrimalResidual {
  double largest = 0.0;  ///< of a component, m/s
  double squares = 0.0;  ///< summed over all components of all points, m²/s²
};

/// u = J v + velocity_bias, a constraint.
/// @param velocity a body; the last entry, of what is fixed, is zero
void find_contact_velocities(std::span<const ContactConstraint> constraints, std::span<const BodyVector> velocity,
                             std::span<ConstraintVector> u);

/// First half of an ADMM iteration: computes u = J v + velocity_bias and the image g = x − R (u − z) of x = y − R z.
/// Returns the primal residual u − z.
/// @param velocity a body; the last entry, of what is fixed, is zero
/// @param u, g, r  a constraint; r = g − x
PrimalResidual relax(std::span<const ContactConstraint> constraints, std::span<const BodyVector> velocity,
                     std::span<ConstraintVector> u, std::span<ConstraintVector> g, std::span<ConstraintVector> r);

/// The map Π of impulses into Coulomb's cone K, |y_t| ≤ μ y_n.
enum class Projection {
  /// The normal part is cut at zero, the tangential part at the disc of radius μ y_n: at the fixed point friction
  /// opposes the slip and the normal velocity is free of it. Not a projection onto a convex set.
  coulomb,
  /// To the nearest point of K. Convex, so that the iteration converges to forces that hold the bodies whenever there
  /// are any; where there are none, the motion that it ends with separates surfaces as they slip, which none does.
  orthogonal
};

/// Second half: projects x onto Coulomb's cone, sets impulse y = Π(x) and contact velocity z = (y − x) / R, and adds
/// J_midᵀ (y + R (z − u)) to `wrench`.
/// @param mid_arms arms of the middle of the step, where impulses act; empty: those of the constraints
/// @param wrench   of a body, added to
/// @param most     a constraint: largest normal impulses, for the orthogonal projection alone; empty: none is
/// bounded
void project(Projection projection, std::span<ContactConstraint> constraints, std::span<const Arms> mid_arms,
             std::span<const ConstraintVector> x, std::span<const ConstraintVector> u,
             std::span<const NormalBounds> most, std::span<LaneWrench> wrench);

/// `relax`, then `project` of x = g, in one pass over the constraints, with the same bits: for iterations that do not
/// accelerate.
PrimalResidual relax_and_project(Projection projection, std::span<ContactConstraint> constraints,
                                 std::span<const Arms> mid_arms, std::span<const BodyVector> velocity,
                                 std::span<const NormalBounds> most, std::span<LaneWrench> wrench);

/// Σ a b / R over all points: the inner products of impulses with several others.
/// @param b   of each its first constraint
/// @param out a product for each b
void dot(std::span<const ContactConstraint> constraints, std::span<const ConstraintVector> a,
         std::span<const ConstraintVector* const> b, std::span<double> out);

/// step = now − last, last = now.
void take_difference(std::span<const ConstraintVector> now, std::span<ConstraintVector> last,
                     std::span<ConstraintVector> step);

/// x = x − Σ weight · history.
void subtract(std::span<const std::vector<ConstraintVector>> history, std::span<const double> weight,
              std::span<ConstraintVector> x);

/// Adds J_midᵀ y to `wrench`.
void add_impulses(std::span<const ContactConstraint> constraints, std::span<const Arms> mid_arms,
                  std::span<LaneWrench> wrench);

/// The most power that impulses in Coulomb's cones can take from a motion, Σ bound · max(0, μ |u_t| − u_n) over all
/// points, with u = J v + velocity_bias and y_n ≤ bound, kg m²/s².
/// @param velocity a body; the last entry, of what is fixed, is zero
/// @param largest  bound of all normal impulses, kg m/s
/// @param most     a constraint: bounds of its own; empty: none
double supported_power(std::span<const ContactConstraint> constraints, std::span<const BodyVector> velocity,
                       double largest, std::span<const NormalBounds> most);

}  // namespace holdfast::internal::native
