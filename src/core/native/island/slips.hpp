#pragma once

#include "core/native/island/island_problem.hpp"
#include "core/native/island/solved_motion.hpp"
#include "core/native/native_options.hpp"

namespace holdfast::internal::native {

/// Finds the manifolds of the island whose surfaces slide now: their friction is kinetic, that of the others static.
/// What slid at the end of the last step goes on for as long as it slips at all.
void find_sliding(Scene& scene, const IslandView& island, const StepTerms& terms, const Effort& effort);

/// Where surfaces begin and cease to slide within a part of a step that has been solved.
class Slips {
 public:
  /// @param solved the problem of the part, with its solution
  /// @param motion of that solution
  Slips(const IslandProblem& solved, const SolvedMotion& motion) : solved_(solved), motion_(motion) {}

  /// Finds the manifolds of the island that slid through the part of the step that has been solved, and that stick at
  /// its end, or carry nothing there. Their cached impulses are those of the solve.
  /// @param residual of the solve, m/s: what sticks may show as much slip
  void find_ended(Scene& scene, const IslandView& island, const StepTerms& terms, double residual) const;

  /// Finds the manifolds that the solve took as sticking, and that slide at its end with all the friction that they may
  /// have. True where there are any: friction gives way within the step, and the step is solved again with less of it.
  /// @param residual of the solve, m/s
  bool find_begun(Scene& scene, const StepTerms& terms, const Effort& effort, double residual) const;

  /// Time until the first slip ends or reverses within the step, and, where that is asked for, through which every slip
  /// that turns lasts at least: friction opposes the mean of a part of the step no longer than this. `step` where none
  /// does.
  /// @param residual of the solve, m/s
  /// @param uncut    the part begins where the step does
  /// @param turns    slips that turn are asked for
  /// @param step     length of the part, s
  double first_change(const Scene& scene, const StepTerms& terms, double residual, bool uncut, bool turns,
                      double step) const;

 private:
  /// Visits the points that slide at the beginning of the part and press.
  /// @param residual of the solve, m/s: it may be all of a slip at the end, which then is zero
  /// @param visit    `void(const Manifold&, const ContactPoint&, const Vec3& slip, const Vec3& end)`: the slip at the
  ///                 beginning and at the end, m/s
  template <class Visit>
  void for_each_slip(const Scene& scene, const StepTerms& terms, double residual, Visit visit) const;

  Vec3 rate(const Scene& scene, const StepTerms& terms, bool changed, const Manifold& manifold,
            const ContactPoint& point, const Vec3& slip) const;

  const IslandProblem& solved_;
  const SolvedMotion& motion_;
};

}  // namespace holdfast::internal::native
