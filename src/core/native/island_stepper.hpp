#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "core/native/contact_kinematics.hpp"
#include "core/native/island_problem.hpp"
#include "core/native/native_options.hpp"
#include "core/native/position_correction.hpp"
#include "core/native/scene.hpp"
#include "core/native/solver/contact_solver.hpp"
#include "core/native/solver/equilibrium.hpp"
#include "core/native/solver/interior_point.hpp"

namespace holdfast::internal::native {

/// What an island's step has cost and reached.
struct IslandReport {
  std::uint64_t iterations = 0;
  double residual = 0.0;        ///< worst of its solves, m/s
  bool missed_contact = false;  ///< bodies overlap where their last contact did not show it, see `is_missed_contact`
};

/// Moves islands. Holds work buffers alone: what it does depends on its arguments only.
class IslandStepper {
 public:
  explicit IslandStepper(const NativeOptions& options, std::unique_ptr<ContactSolver> solver = make_contact_solver())
      : options_(options), solver_(std::move(solver)) {}

  /// True when the bodies, all without velocity, stay where they are under the effective gravity: forces within every
  /// contact's cone are found that balance each body to the tolerance. The cached impulses are set to these forces;
  /// they stay as they are where they already balance.
  /// @param leans some bodies lean on others that they have not yet pushed: only those may hold them that they push as
  ///              they begin to move by Coulomb's law
  bool rests(Scene& scene, const IslandView& island, const StepTerms& terms, bool leans, IslandReport& report);

  /// Adds the forces with which the island, which rests, presses the sides to `scene.resting_pushes`. Statics leaves
  /// open how floor and walls share them: the walls get the least that balances the load in its pose, whatever came
  /// before. Changes nothing else.
  void find_resting_pushes(Scene& scene, const IslandView& island, const StepTerms& terms);

  /// Takes overlaps above a length out of the island, by displacements that never feed velocities. Nothing may sleep:
  /// between bodies that do not give way, others would be squeezed out.
  void correct_positions(Scene& scene, const IslandView& island, const StepTerms& terms);

  /// Takes the island a step forward, cut at its events. Activates manifolds that the bodies would overlap at.
  void advance(Scene& scene, const IslandView& island, const StepTerms& terms, IslandReport& report);

 private:
  /// The first overlap that a step would bring.
  struct Event {
    bool activated = false;                                 ///< manifolds became active: the step must be solved again
    double time = std::numeric_limits<double>::infinity();  ///< of the first fast impact, s from the step's start
  };

  /// A part of a step that is solved: up to an event, or to the step's end.
  struct Part {
    double length = 0.0;       ///< that was solved for, s
    double impact_time = 0.0;  ///< s from the part's start; infinite: no impact cuts it
    SolveResult result;
  };

  // Parts of a step, in their order.
  void resolve_impacts(Scene& scene, const IslandView& island, const StepTerms& terms, double step,
                       IslandReport& report);
  Part solve_part(Scene& scene, const IslandView& island, const StepTerms& terms, const SolveLimits& limits,
                  double remaining, IslandReport& report);
  bool jumps(const Bodies& bodies, std::uint32_t body, const StepTerms& terms, double step) const;
  void find_mean_velocities(const Bodies& bodies, const IslandView& island, const StepTerms& terms, double step);
  void integrate(Scene& scene, const IslandView& island, double step, double share);
  bool update_manifold(Scene& scene, std::uint32_t index, const StepTerms& terms) const;

  // Solves.
  SolveLimits step_limits(const Scene& scene, const IslandView& island, const StepTerms& terms) const;
  SolveLimits limits_after_reset() const;
  SolveLimits repeated_limits(SolveLimits limits, const IslandView& island) const;
  void keep_solution(const IslandView& island, std::size_t bodies);
  SolveResult solve(SolveLimits limits, const StepTerms& terms, double step, IslandReport& report);
  SolveResult solve_once(const SolveLimits& limits, IslandReport& report);

  // Events within a step.
  PointFilter point_filter(const StepTerms& terms, double step) const;
  double located_speed(const StepTerms& terms) const;
  double turning_speed(const Bodies& bodies, const IslandView& island, const StepTerms& terms) const;
  Twist end_twist(const Bodies& bodies, std::int32_t body) const;
  Vec3 end_velocity(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) const;
  Twist mean_twist(const Bodies& bodies, std::int32_t body) const;
  double end_normal_velocity(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) const;
  bool propagate_impact(const Scene& scene, const IslandView& island, const StepTerms& terms, double step);
  Event find_overlap(Scene& scene, const IslandView& island, const StepTerms& terms, double step);
  void activate_nearby(Scene& scene, const IslandView& island, const StepTerms& terms, double step) const;
  double kinetic_slip(const StepTerms& terms) const;
  double beginning_slip(const StepTerms& terms, double residual) const;
  void find_sliding(Scene& scene, const IslandView& island, const StepTerms& terms) const;
  void find_ended_slips(Scene& scene, const IslandView& island, const StepTerms& terms, double residual) const;
  bool find_begun_slips(Scene& scene, const StepTerms& terms, double residual) const;
  double first_slip_end(const Scene& scene, const StepTerms& terms, double step) const;

  // Proof of rest.
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
  Effort effort_;           ///< for the island that is stepped
  IslandProblem prepared_;  ///< what is being solved
  std::unique_ptr<ContactSolver> solver_;
  EquilibriumCheck equilibrium_;
  InteriorPoint interior_point_;
  PositionCorrection correction_;
  std::vector<ConstraintVector> start_impulses_;  ///< a constraint of the proof of rest, before a sum is tried
  std::vector<KnownBalances::Contact> contacts_;  ///< a constraint of the proof of rest
  std::vector<std::uint8_t> jumps_;               ///< a body of the scene: see `jumps`, of the last solve
  std::vector<BodyVector> mean_velocity_;         ///< a body of the scene: over the part of the step that is solved
  std::vector<BodyVector> found_;                 ///< a body of the scene: velocity by the solve that is repeated
  PointBits impacting_;                           ///< points that take part in an impact
  PointBits could_impact_;                        ///< those that touch, and take part where the impact reaches them
  PointBits predicted_;          ///< points that are solved because they were found to close within the step
  double turning_speed_ = 0.0;   ///< at the start of the part that is solved, see `turning_speed`
  bool locates_impacts_ = true;  ///< impacts that lie ahead may cut the step; else they are solved at its end
  int impact_cuts_ = 0, slip_end_cuts_ = 0;  ///< of the step so far
};

}  // namespace holdfast::internal::native
