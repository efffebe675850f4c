#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/native/solver/contact_problem.hpp"
#include "core/native/solver/contact_solver.hpp"

namespace holdfast::internal::native {

/// How hard the Gauss-Seidel method tries.
struct PointLimits {
  double tolerance = 0.0;                   ///< the velocity of no point may be farther from its law, m/s
  double worst_residual = 0.0;              ///< that may pass, m/s
  std::size_t visits = kGaussSeidelVisits;  ///< to points, at most, where what is left may pass
  std::size_t more_visits = kMoreIterations * kGaussSeidelVisits;  ///< on top of these, where it may not
};

/// Projected Gauss-Seidel method for contact problems (M. Jean, "The non-smooth contact dynamics method", Computer
/// Methods in Applied Mechanics and Engineering 177, 1999), under-relaxed: every point in turn takes a share of the
/// step to the impulse that Coulomb's law gives it while all others stay. In large islands its sweeps gain far less
/// than iterations of the splitting. But where friction wedges bodies, so that tangential impulses make the normal
/// ones, it converges and the splitting goes round in circles. Without the under-relaxation it may do so too. Holds
/// work buffers alone.
class GaussSeidel {
 public:
  /// Replaces the problem's velocities, impulses and contact velocities by better ones, which start from the impulses
  /// that are there. Bounds of normal impulses are not looked at.
  /// @param limits a sweep that has begun is finished
  /// @return with `iterations` sweeps, and the largest such distance of the last one as the residual; infinite where
  /// velocities are not numbers
  SolveResult solve(ContactProblem& problem, const PointLimits& limits);

 private:
  using Velocity = Eigen::Matrix<double, kBodyRows, 1>;  ///< three linear and three angular components

  /// What a point has to do with one of its bodies; all zero with what is fixed.
  struct Side {
    std::size_t body = 0;
    Eigen::Matrix<double, 3, kBodyRows> velocity_at =
        Eigen::Matrix<double, 3, kBodyRows>::Zero();  ///< the point's velocity, of the body's
    Eigen::Matrix<double, kBodyRows, 3> response =
        Eigen::Matrix<double, kBodyRows, 3>::Zero();  ///< the body's velocity, of the point's impulse
  };

  struct Point {
    Side a, b;
    Vec3 bias = Vec3::Zero(), impulse = Vec3::Zero();
    double friction = 0.0;
    Vec3 normal_response = Vec3::Zero();  ///< the point's velocity that a normal impulse makes, 1/kg
    double tangential_response = 0.0;     ///< no less than the largest that a tangential impulse makes, 1/kg
  };

  void begin(const ContactProblem& problem);
  Side side(const ContactProblem& problem, std::int32_t body, const Mat3& directions, const Vec3& arm,
            const Vec3& mid_arm) const;
  Vec3 velocity(const Point& point) const;
  double visit(Point& point);
  void finish(ContactProblem& problem) const;

  std::vector<Point> points_;
  std::vector<Mat3> inverse_inertia_;
  std::vector<Velocity> velocity_;  ///< a body; the last is of what is fixed
};

}  // namespace holdfast::internal::native
