#pragma once

#include <algorithm>

#include "core/native/island/island_solve.hpp"
#include "core/native/island/solved_motion.hpp"

namespace holdfast::internal::native {

/// Which impacts of a part of a step are located in time, and which contacts are solved with it.
struct ImpactTiming {
  /// Speed from which impacts are located, m/s. Where none may cut a step, it only tells which contacts count as
  /// closed.
  double located_speed = 0.0;
  /// Whether impacts that lie ahead may cut the step; else they are solved at its end.
  bool locates = true;

  /// Which contacts are solved in a step of this length, s: those that are closed, those that close slower than what is
  /// located in time, and, where nothing more is located, all that close.
  PointFilter filter(double step) const {
    return {.closed_gap = std::max(kTouch, located_speed * step), .takes_closing = !locates};
  }
};

/// The timing of a part of a step.
/// @param crowd boxes of the island meet at any time: contacts count as closed that close by the slop in the step
/// @param cuts  times that impacts have cut the step so far
ImpactTiming impact_timing(const Bodies& bodies, const IslandView& island, const StepTerms& terms, const Effort& effort,
                           bool crowd, int cuts);

/// Solves the impacts at the start of a part of a step: bodies leave with the velocities after them.
class Impacts {
 public:
  /// @param solve  what solves the island
  /// @param motion of its solutions
  Impacts(IslandSolve& solve, const SolvedMotion& motion) : solve_(solve), motion_(motion) {}

  /// @param step length of the part, s
  void resolve(Scene& scene, const IslandView& island, const StepTerms& terms, const Effort& effort,
               const ImpactTiming& timing, double step, IslandReport& report);

 private:
  bool propagate(const Scene& scene, const IslandView& island, const StepTerms& terms, const PointFilter& filter,
                 double step);

  IslandSolve& solve_;
  const SolvedMotion& motion_;
  PointBits impacting_;     ///< points that take part in an impact
  PointBits could_impact_;  ///< those that touch, and take part where the impact reaches them
};

}  // namespace holdfast::internal::native
