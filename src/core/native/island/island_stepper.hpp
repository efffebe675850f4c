#pragma once

#include <memory>
#include <vector>

#include "core/native/island/closing_contacts.hpp"
#include "core/native/island/impacts.hpp"
#include "core/native/island/island_solve.hpp"
#include "core/native/island/position_correction.hpp"
#include "core/native/island/rest_proof.hpp"
#include "core/native/island/slips.hpp"
#include "core/native/island/solved_motion.hpp"

namespace holdfast::internal::native {

/// Moves islands. Holds work buffers alone: what it does depends on its arguments only.
class IslandStepper {
 public:
  explicit IslandStepper(const NativeOptions& options, std::unique_ptr<ContactSolver> solver = make_contact_solver())
      : options_(options), solve_(std::move(solver)) {}
  IslandStepper(const IslandStepper&) = delete;
  IslandStepper& operator=(const IslandStepper&) = delete;

  /// Whether an island rests.
  RestProof& rest_proof() { return rest_proof_; }

  /// Takes overlaps above a length out of the island, by displacements that never feed velocities. Nothing may sleep:
  /// between bodies that do not give way, others would be squeezed out.
  void correct_positions(Scene& scene, const IslandView& island, const StepTerms& terms);

  /// Takes the island a step forward, cut at its events. Activates manifolds that the bodies would overlap at.
  void advance(Scene& scene, const IslandView& island, const StepTerms& terms, IslandReport& report);

 private:
  /// A part of a step that is solved: up to an event, or to the step's end.
  struct Part {
    double length = 0.0;       ///< that was solved for, s
    double impact_time = 0.0;  ///< s from the part's start; infinite: no impact cuts it
    SolveResult result;
  };

  Part solve_part(Scene& scene, const IslandView& island, const StepTerms& terms, const SolveLimits& limits,
                  const ImpactTiming& timing, double remaining, IslandReport& report);
  SolveLimits step_limits(const Scene& scene, const IslandView& island, const StepTerms& terms) const;
  void keep_solution(const IslandView& island, std::size_t bodies);
  bool update_manifold(Scene& scene, std::uint32_t index, const StepTerms& terms) const;

  NativeOptions options_;
  Effort effort_;  ///< for the island that is stepped
  IslandSolve solve_;
  SolvedMotion motion_{solve_.prepared};
  Impacts impacts_{solve_, motion_};
  ClosingContacts closing_{motion_};
  Slips slips_{solve_.prepared, motion_};
  RestProof rest_proof_{options_, solve_};
  PositionCorrection correction_;
  std::vector<BodyVector> found_;        ///< a body of the scene: velocity by the solve that is repeated
  int impact_cuts_ = 0, slip_cuts_ = 0;  ///< of the step so far
};

}  // namespace holdfast::internal::native
