#pragma once

#include <vector>

#include "core/native/solver/contact_problem.hpp"

namespace holdfast::internal::native {

/// Judges whether bodies can be at rest. Holds work buffers alone.
class EquilibriumCheck {
 public:
  /// Largest force that is left on a body at rest under the problem's impulses, over its weight m · `velocity_unit`;
  /// torques over the radius. Infinite where an impulse is not a number.
  double residual(const ContactProblem& problem, double velocity_unit);

  /// Whether the problem's velocities prove that no impulses in Coulomb's cones balance the bodies at rest.
  /// Balance means Jᵀy = −M v*; then v · M v* = −Σ y · J v for every motion v, and an impulse y of the cone takes no
  /// more than −y · u ≤ y_n (μ |u_t| − u_n). A motion to which gravity and forces from outside give more than that
  /// refutes balance. (It is Farkas' lemma; the iteration with the orthogonal projection converges to such a motion
  /// where there is one.)
  /// @param largest_impulse no impulse of a balance is larger than this, kg m/s
  bool refutes_rest(const ContactProblem& problem, double largest_impulse);

 private:
  std::vector<LaneWrench> wrench_;
  std::vector<BodyVector> force_, motion_;
  std::vector<double> speed_, power_;  ///< a body: its speed, m/s; what gravity and forces from outside give to it
};

}  // namespace holdfast::internal::native
