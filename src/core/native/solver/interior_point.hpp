#pragma once

#include <cstdint>
#include <vector>

#include "core/native/solver/block_ldlt.hpp"
#include "core/native/solver/contact_problem.hpp"
#include "core/native/solver/interior_point_kernels.hpp"

namespace holdfast::internal::native {

/// Primal-dual interior point method for bodies at rest: it ends with impulses that balance them, or with a motion that
/// proves that there are none. Each iteration takes a factorisation and gains a digit or two, where the splitting's
/// gain less the nearer the load is to its limit of balance.
///
/// Solved is the quadratic program over cones
///
///   min ½ (v − v*) · M (v − v*)   over v with J v ∈ K*,
///
/// with K = {y: |y_t| ≤ μ y_n} and its dual K* = {u: u_n ≥ μ |u_t|}. Its optimality conditions are
///
///   M (v − v*) = Jᵀ y,    s = J v + c + λ n,    K ∋ y ⊥ s ∈ K*,    0 ≤ λ ⊥ p = bound − y_n ≥ 0,
///
/// with the last pair at bounded points only. Without the bias c, v = 0 solves it where, and only where, impulses
/// balance the load; else v is the motion of Farkas' lemma, see `EquilibriumCheck::refutes_rest`. A bias is a cost: of
/// all impulses that balance the load, those with the least c · y solve it, up to a motion as small as c.
///
/// Steps are those of Mehrotra's predictor and corrector with the scaling of Nesterov and Todd (L. Vandenberghe, "The
/// CVXOPT linear and quadratic cone program solvers", 2010). Eliminating all but Δv leaves the matrix M + Jᵀ R J of the
/// splitting, with a full 3×3 matrix R of each point.
class InteriorPoint {
 public:
  /// Begins with the problem, bodies in their order of elimination, from inside of all cones.
  /// @param velocity_unit  speed that loads gain within the step, |g − a| h, m/s
  void start(ContactProblem& problem, double velocity_unit);

  /// Replaces the problem's velocities, impulses, and contact velocities, which are s, by better ones. False, with
  /// nothing replaced, where rounding leaves no better ones.
  bool iterate(ContactProblem& problem);

  /// Sum of the products of complementary variables before the last iteration, kg m²/s²: by how much c · y may exceed
  /// the least.
  double gap() const { return gap_; }

 private:
  void place(const ContactProblem& problem, std::size_t constraint, std::size_t lane, double velocity_unit);
  void factorise(const ContactProblem& problem);
  double find_direction(ContactProblem& problem, const InteriorTarget& target);

  BlockLdlt ldlt_;
  std::vector<InteriorPoints> points_;  ///< a constraint
  double gap_ = 0.0;
  double pairs_ = 0.0;  ///< of complementary variables
  std::vector<ConstraintMatrix> resistance_;
  std::vector<ConstraintVector> u_, change_;  ///< J v, J Δv
  std::vector<LaneWrench> wrench_;
  std::vector<BodyVector> dv_;
};

}  // namespace holdfast::internal::native
