#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace holdfast::internal {

/// Bullet's solver, which also records its iterations and residuals. It is called once per group of islands.
class MeasuringSolver final : public btSequentialImpulseConstraintSolver {
 public:
  /// Iterations over all calls.
  std::uint64_t iterations() const { return iterations_; }

  /// Largest change of a constraint's velocity in a last iteration since the last call of this function, m/s.
  double take_residual() { return std::exchange(residual_, 0.0); }

 protected:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** constraints, int constraint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) override {
    const btScalar result = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyIterations(
        bodies, body_count, manifolds, manifold_count, constraints, constraint_count, info, drawer);
    // m_leastSquaresResidual is the largest squared change of velocity in the last iteration.
    if (manifold_count > 0) {
      iterations_ += static_cast<std::uint64_t>(info.m_numIterations);
      residual_ = std::max(residual_, std::sqrt(static_cast<double>(m_leastSquaresResidual)));
    }
    return result;
  }

 private:
  std::uint64_t iterations_ = 0;
  double residual_ = 0.0;
};

}  // namespace holdfast::internal
