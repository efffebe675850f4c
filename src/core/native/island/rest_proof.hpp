#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/native/island/island_solve.hpp"
#include "core/native/solver/equilibrium.hpp"
#include "core/native/solver/interior_point.hpp"

namespace holdfast::internal::native {

/// Decides whether the bodies of an island stay where they are. Holds work buffers alone.
class RestProof {
 public:
  /// @param solve what solves the island
  RestProof(const NativeOptions& options, IslandSolve& solve)
      : options_(options), solve_(solve), prepared_(solve.prepared) {}

  /// True when the bodies, all without velocity, stay where they are under the effective gravity: forces within every
  /// contact's cone are found that balance each body to the tolerance. The cached impulses are set to these forces;
  /// they stay as they are where they already balance. Where none are found, the bodies' accelerations are those with
  /// which they begin to move.
  /// @param leans some bodies lean on others that they have not yet pushed: only those may hold them that they push as
  ///              they begin to move by Coulomb's law
  bool rests(Scene& scene, const IslandView& island, const StepTerms& terms, bool leans, IslandReport& report);

  /// Finds the forces with which the island, which rests, presses the sides, for the scene's `side_forces`. Statics
  /// leaves open how floor and walls share them: the walls get the least that balances the load in its pose, whatever
  /// came before. Changes nothing else.
  void find_resting_pushes(Scene& scene, const IslandView& island, const StepTerms& terms);

 private:
  bool balances(const StepTerms& terms);
  KnownBalances::Island known_as(const Scene& scene, const IslandView& island);
  bool balances_between(Scene& scene, const KnownBalances::Island& island, const StepTerms& terms);
  bool balances_beyond(Scene& scene, const KnownBalances::Island& island, const StepTerms& terms, IslandReport& report);
  std::optional<bool> balance_of_prepared(const StepTerms& terms);
  std::optional<bool> settle(const StepTerms& terms, IslandReport& report);
  std::optional<bool> judge_by_motion(const StepTerms& terms, IslandReport& report);
  bool minimise_wall_forces(const Scene& scene, const StepTerms& terms);
  bool decide_balance(const StepTerms& terms, IslandReport& report);
  double find_beginning_motion(SolveLimits limits, double tolerance, const StepTerms& terms, IslandReport& report);
  bool admit_pushed(const Scene& scene);

  NativeOptions options_;
  IslandSolve& solve_;
  IslandProblem& prepared_;  ///< what `solve_` solves
  Effort effort_;            ///< for the island
  EquilibriumCheck equilibrium_;
  InteriorPoint interior_point_;
  std::vector<ConstraintVector> start_impulses_;  ///< a constraint, before a sum of known balances is tried
  std::vector<KnownBalances::Contact> contacts_;  ///< a constraint
};

}  // namespace holdfast::internal::native
