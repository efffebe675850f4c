#pragma once

#include <cstdint>
#include <vector>

#include "core/native/collision/oriented_box.hpp"
#include "core/native/solver/block_ldlt.hpp"
#include "core/native/solver/contact_problem.hpp"
#include "core/native/solver/lorentz_cone.hpp"

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
///   M (v − v*) = Jᵀ y,    s = J v + λ n,    K ∋ y ⊥ s ∈ K*,    0 ≤ λ ⊥ p = bound − y_n ≥ 0,
///
/// with the last pair at bounded points only. v = 0 solves it where, and only where, impulses balance the load; else v
/// is the motion of Farkas' lemma, see `EquilibriumCheck::refutes_rest`.
///
/// Steps are those of Mehrotra's predictor and corrector with the scaling of Nesterov and Todd (L. Vandenberghe, "The
/// CVXOPT linear and quadratic cone program solvers", 2010). Eliminating all but Δv leaves the matrix M + Jᵀ R J of the
/// splitting, with a full 3×3 matrix R of each point.
class InteriorPoint {
 public:
  /// Begins with the problem, bodies in their order of elimination, from inside of all cones. Velocities have no bias.
  /// @param velocity_unit  speed that loads gain within the step, |g − a| h, m/s
  void start(ContactProblem& problem, double velocity_unit);

  /// Replaces the problem's velocities, impulses, and contact velocities, which are s, by better ones. False, with
  /// nothing replaced, where rounding leaves no better ones.
  bool iterate(ContactProblem& problem);

 private:
  /// A contact point. Members in Lorentz coordinates are those of a constraint with the normal part times (impulses)
  /// or over (velocities) μ: both cones are then the Lorentz cone.
  struct Point {
    std::uint32_t constraint = 0;
    std::uint32_t lane = 0;
    double friction = 1.0;    ///< μ; 1 where there is none
    double tangential = 1.0;  ///< 0 where there is no friction, else 1
    double bound = 0.0;       ///< of the normal impulse, where it is bounded
    bool bounded = false;
    Vec3 y = Vec3::Zero(), s = Vec3::Zero();  ///< Lorentz coordinates
    double p = 0.0, l = 0.0;                  ///< slack and multiplier λ of the bound

    // Of an iteration:
    lorentz::Scaling scaling;
    Mat3 resistance = Mat3::Zero();             ///< R, kg
    Vec3 drive = Vec3::Zero();                  ///< g of Δy = R (g − J Δv), m/s
    Vec3 dy = Vec3::Zero(), ds = Vec3::Zero();  ///< Lorentz coordinates
    double dp = 0.0, dl = 0.0;

    Vec3 impulse() const { return {y[0] / friction, tangential * y[1], tangential * y[2]}; }
    Vec3 velocity() const { return {friction * s[0], s[1], s[2]}; }
    double complementarity() const { return y.dot(s) + p * l; }
    double bound_residual() const { return p - bound + y[0] / friction; }
    /// Right-hand side of the Newton equation of p l = target.
    double bound_change(double target, bool corrects) const { return target - p * l - (corrects ? dp * dl : 0.0); }
  };

  void add_point(const ContactProblem& problem, std::uint32_t constraint, std::uint32_t lane, double velocity_unit);
  void factorise(const ContactProblem& problem);
  void find_resistance(Point& point) const;
  double find_direction(ContactProblem& problem, double target, bool corrects);
  void find_drive(Point& point, double target, bool corrects) const;
  double step_at(Point& point, double target, bool corrects, const Vec3& change) const;
  void write(ContactProblem& problem) const;

  BlockLdlt ldlt_;
  std::vector<Point> points_;
  double pairs_ = 0.0;  ///< of complementary variables
  std::vector<ConstraintMatrix> resistance_;
  std::vector<ConstraintVector> u_, change_;  ///< J v, J Δv
  std::vector<LaneWrench> wrench_;
  std::vector<BodyVector> dv_;
};

}  // namespace holdfast::internal::native
