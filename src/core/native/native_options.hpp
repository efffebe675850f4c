#pragma once

#include <cstddef>

#include "core/model/settings.hpp"
#include "core/native/constants.hpp"

namespace holdfast::internal::native {

// Before a field stands what it means, behind it its unit, or what it is a share or a multiple of: as in
// `constants.hpp`, `tools/parameters_page.py` makes docs/physics/parameters.md of this and of the values of each
// accuracy.

/// How hard the moving steps of an island are solved.
struct Effort {
  /// Residual with which a solve of a step ends. Where g − a oscillates, that of small islands holds for large ones
  /// too.
  double tolerance = 1e-5;  // |g − a| h
  /// Iterations of a solve, at most, where what is left may pass. `reset_iterations` where g − a oscillates.
  int iterations = 30;  // iterations
  /// Residual that may pass: root mean square over the contact points. `kNegligible` where g − a oscillates.
  double mean_residual = kSlack;  // |g − a| h
  /// Times that impacts may cut a step. Where g − a oscillates, slips that end or turn may twice as often.
  int impact_cuts = 8;  // times
  /// Times that the end of a slip may cut a step elsewhere.
  int slip_end_cuts = 2;  // times
  /// Overlap from which positions are corrected. Where no impact may cut a step, and in large islands, contacts which
  /// close within the step and are solved as closed close by this length at most. Of large islands also: overlap of a
  /// missed contact from which a step is taken again; and twice the overlap that a step may end with before a contact
  /// is solved, which is less than any real step that stops a box.
  double slop = kContactTolerance;  // m
  /// Penalty R along the normal, and along the tangents where a contact sticks.
  double sticking_penalty = kStickingPenalty;  // of the carried mass
  /// Penalty R along the tangents where a contact slides.
  double sliding_penalty = kMovingSlidingPenalty;  // of the carried mass
  /// Residual with which a solve ends whose warm start is reset, because the acceleration has just changed.
  double reset_tolerance = kNegligible * tolerance;  // |g − a| h
  /// Iterations of such a solve, at most.
  int reset_iterations = kResetIterations * iterations;  // iterations
  /// Overlap that a step may end with before a contact is solved that can carry no weight; `kNegligible` of `kTouch`
  /// where it can.
  double penetration_slop = kTouch;  // m
};

/// All settings of the native engine: those of the accuracy, with the keys of the configuration that override them.
struct NativeOptions {
  /// Steps per second of simulated time, at least.
  double steps_per_second = 240.0;  // 1/s
  /// For islands of at most `kSmallIslandBodies`. Of larger ones in which one body moves: the tolerances, residuals,
  /// iterations and penalties, and how often a slip that ends may cut a step.
  Effort small_island;
  /// For larger ones. Their impacts are solved at the end of a step, since there are many at any time, and to locate
  /// them takes five times as long. They are located while one body moves alone, and, while the acceleration goes to
  /// and fro, in islands of up to `kMediumIslandBodies`.
  Effort large_island{.iterations = 12,
                      .impact_cuts = 2,
                      .slip_end_cuts = 0,
                      .slop = 2e-4,
                      .sticking_penalty = kLargeIslandStickingPenalty,
                      .sliding_penalty = kLargeIslandSlidingPenalty};
  /// Equilibrium residual of a body at rest, at most. A body that gains more speed than this many |g − a| h in a step
  /// does not fall asleep: what begins to slide or to tip, however slowly, gains speed in every step.
  double rest_tolerance = 1e-8;  // of m |g − a|
  /// Whether slow bodies sleep in islands of more than `kMediumIslandBodies` that move.
  bool sleep = true;  // yes or no
  /// Whether time goes to the end of the phase where all bodies rest.
  bool jump = true;  // yes or no
  /// Whether islands at rest are left alone until something touches them.
  bool freeze = true;  // yes or no

  const Effort& effort(std::size_t bodies) const { return bodies > kSmallIslandBodies ? large_island : small_island; }
};

NativeOptions native_options(const Settings& settings);

/// Calls `visit(name, value)` for every field.
template <class Visit>
void visit_fields(const Effort& effort, Visit visit) {
  // A new field fails to compile here.
  const auto& [tolerance, iterations, mean_residual, impact_cuts, slip_end_cuts, slop, sticking_penalty,
               sliding_penalty, reset_tolerance, reset_iterations, penetration_slop] = effort;
  visit("tolerance", tolerance);
  visit("iterations", iterations);
  visit("mean_residual", mean_residual);
  visit("impact_cuts", impact_cuts);
  visit("slip_end_cuts", slip_end_cuts);
  visit("slop", slop);
  visit("sticking_penalty", sticking_penalty);
  visit("sliding_penalty", sliding_penalty);
  visit("reset_tolerance", reset_tolerance);
  visit("reset_iterations", reset_iterations);
  visit("penetration_slop", penetration_slop);
}

/// The same; an `Effort` is a value too.
template <class Visit>
void visit_fields(const NativeOptions& options, Visit visit) {
  const auto& [steps_per_second, small_island, large_island, rest_tolerance, sleep, jump, freeze] = options;
  visit("steps_per_second", steps_per_second);
  visit("small_island", small_island);
  visit("large_island", large_island);
  visit("rest_tolerance", rest_tolerance);
  visit("sleep", sleep);
  visit("jump", jump);
  visit("freeze", freeze);
}

}  // namespace holdfast::internal::native
