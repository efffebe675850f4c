#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/native/solver/anderson.hpp"
#include "core/native/solver/block_ldlt.hpp"
#include "core/native/solver/contact_solver.hpp"

namespace holdfast::internal::native {

/// ADMM contact solver: hard contacts with the exact Coulomb cone at the velocity level (Moreau 1988), by operator
/// splitting with one sparse factorisation for many iterations,
///
///   A = M + J_midᵀ R J_mid,    x = y − R (z + α (J v − z)),    y = Π(x),    z = (y − x) / R,
///   v ← v + A⁻¹ (M (v* − v) + J_midᵀ (y + R (z − J v))).
///
/// Π cuts the normal part at zero and the tangential part at the disc of radius μ y_n: at the fixed point Coulomb's
/// law holds exactly, without the dilation of convex cones. The residual form keeps the fixed point exact whatever
/// A is made of, so that arms of mid step and end of step may differ.
class AdmmSolver final : public ContactSolver {
 public:
  std::span<const std::uint32_t> order(std::size_t count, std::span<const BodyPair> pairs) override;
  SolveResult solve(ContactProblem& problem, const SolveLimits& limits) override;

 private:
  bool refit_penalty(ContactProblem& problem, const SolveLimits& limits, std::size_t points);
  void factorise(const ContactProblem& problem);

  BlockLdlt ldlt_;
  std::vector<BodyPair> ordered_pairs_;  ///< of the last `order`, as the renumbered problem has them
  std::size_t ordered_count_ = 0;
  Anderson anderson_;
  std::vector<ConstraintVector> u_, g_, r_;
  std::vector<LaneWrench> wrench_;
  std::vector<BodyVector> change_;
};

}  // namespace holdfast::internal::native
