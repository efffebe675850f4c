#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/native/collision/oriented_box.hpp"
#include "core/native/solver/body_block.hpp"
#include "core/native/solver/contact_constraint.hpp"

namespace holdfast::internal::native {

inline Vec3 linear(const BodyVector& v) { return {v.row[0], v.row[1], v.row[2]}; }
inline Vec3 angular(const BodyVector& v) {
  return {v.row[kAngularRow], v.row[kAngularRow + 1], v.row[kAngularRow + 2]};
}
inline BodyVector body_vector(const Vec3& linear, const Vec3& angular) {
  return {{linear.x(), linear.y(), linear.z(), 0.0, angular.x(), angular.y(), angular.z(), 0.0}};
}

/// What a body's mass does in a solve.
struct ProblemBody {
  double mass = 0.0;            ///< kg
  Mat3 inertia = Mat3::Zero();  ///< container frame, at the end of the step, kg m²
  double radius = 0.0;          ///< of the sphere around the box, m
};
static_assert(offsetof(ProblemBody, radius) == offsetof(ProblemBody, inertia) + sizeof(Mat3));

/// Bodies that contacts join, as plain data: what a contact solver reads, and the start values that it replaces by the
/// solution. Bodies are in the order in which the solver wants to eliminate them, see `ContactSolver::order`; the index
/// `bodies.size()` stands for everything that is fixed.
///
/// Wanted are the velocities v and the impulses y of the contacts with
///
///   M (v − v*) = J_midᵀ y,    u = J v + bias,    0 ≤ u_n ⊥ y_n ≥ 0,    |y_t| ≤ μ y_n, against u_t where that is not 0.
struct ContactProblem {
  std::vector<ProblemBody> bodies;
  std::vector<BodyVector> free_velocity;  ///< v*, of a body without contacts
  std::vector<BodyVector> velocity;       ///< v; one more than bodies, the last is zero
  std::vector<ContactConstraint> constraints;
  std::vector<Arms> mid_arms;                  ///< arms of J_mid, a constraint; empty: those of the constraints
  std::vector<NormalBounds> normal_bounds;     ///< largest normal impulses, a constraint; empty: none is bounded
  std::vector<BodyPair> pairs;                 ///< of bodies that share constraints, without repetition
  std::vector<std::uint32_t> constraint_pair;  ///< a constraint: index into `pairs`; `kNoPair` with what is fixed
  double impulse_per_mass = 1.0;  ///< impulse that a kilogram brings to bear in the step, m/s: the unit of impulses
  bool continues = false;  ///< the solver's last problem was this one, with the impulses that are there: it may go on
                           ///< from its factor and memory

  /// Drops the impulses, and the difference between the arms, and starts from the free velocities: what helps where
  /// an iteration diverges because bodies turn far within the step.
  void reset_warm_start();

  /// Of all bodies, kg.
  double mass() const;
};

/// Finds what the impulses give each body beyond its velocity, M (v* − v) + J_midᵀ y, kg m/s and kg m²/s: what a solve
/// has left of the momentum equation. It is zero at the solution.
/// @param wrench a work buffer
void find_missing_momentum(const ContactProblem& problem, std::vector<LaneWrench>& wrench,
                           std::vector<BodyVector>& missing);

/// Whether every impulse is in its cone, y_n ≥ 0 and |y_t| ≤ μ y_n up to rounding; numbers that are none count as in
/// it.
bool impulses_are_in_cones(const ContactProblem& problem);

/// Whether no normal impulse is above its bound, up to rounding.
bool impulses_are_in_bounds(const ContactProblem& problem);

/// No point of the body moves faster than this, m/s.
double largest_speed(const ContactProblem& problem, std::size_t body);

/// No point of any body moves faster than this, m/s.
double largest_speed(const ContactProblem& problem);

}  // namespace holdfast::internal::native
