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
  /// Residual with which a solve of a step ends.
  double tolerance = 1e-4;  // |g − a| h
  /// The same where the warm start is reset, because the acceleration has just changed.
  double reset_tolerance = 1e-7;  // |g − a| h
  /// Iterations of a solve, at most, where what is left may pass.
  int iterations = 60;  // iterations
  /// The same where the acceleration has just changed.
  int reset_iterations = 400;  // iterations
  /// Residual that may pass: root mean square over the contact points.
  double mean_residual = 0.01;  // |g − a| h
  /// Times that impacts may cut a step.
  int impact_cuts = 8;  // times
  /// Where no impact may cut a step: length that contacts which close within the step and are solved as closed close
  /// by at most.
  double closing_length = 2e-4;  // m
  /// Times that the end of a slip may cut a step.
  int slip_end_cuts = 2;  // times
  /// Overlap from which positions are corrected.
  double overlap = 1e-5;  // m
  /// Overlap that a step may end with before a contact is solved, where this is more than `kPenetrationSlop` allows.
  double penetration_slop = 0.0;  // m
  /// Penalty R along the normal, and along the tangents where a contact sticks.
  double sticking_penalty = kStickingPenalty;  // of the carried mass
  /// Penalty R along the tangents where a contact slides.
  double sliding_penalty = kMovingSlidingPenalty;  // of the carried mass
  /// R is fitted anew where more of the points than this call for another one.
  double refit_share = kRefitShare;  // of the points
};

/// All settings of the native engine: those of the accuracy, with the keys of the configuration that override them.
struct NativeOptions {
  /// Steps per second of simulated time, at least.
  double steps_per_second = 240.0;  // 1/s
  Effort small_island;              ///< for islands of at most `kSmallIslandBodies`
  /// For larger ones. Their impacts are solved at the end of a step, but for islands of up to `kLocatedIslandBodies`
  /// while the acceleration goes to and fro: there are many at any time, and to locate them takes five times as long.
  Effort large_island{.iterations = 12,
                      .reset_iterations = 24,
                      .mean_residual = 0.02,
                      .impact_cuts = 2,
                      .slip_end_cuts = 0,
                      .overlap = 2e-4,
                      .penetration_slop = 1e-4,
                      .sticking_penalty = kLargeIslandStickingPenalty,
                      .sliding_penalty = kLargeIslandSlidingPenalty,
                      .refit_share = kLargeIslandRefitShare};
  /// Equilibrium residual of a body at rest, at most.
  double rest_tolerance = 1e-8;  // of m |g − a|
  /// Overlap of a missed contact from which a step is taken again.
  double missed_contact_overlap = 2e-4;  // m
  /// Whether slow bodies of large islands that move sleep.
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
  const auto& [tolerance, reset_tolerance, iterations, reset_iterations, mean_residual, impact_cuts, closing_length,
               slip_end_cuts, overlap, penetration_slop, sticking_penalty, sliding_penalty, refit_share] = effort;
  visit("tolerance", tolerance);
  visit("reset_tolerance", reset_tolerance);
  visit("iterations", iterations);
  visit("reset_iterations", reset_iterations);
  visit("mean_residual", mean_residual);
  visit("impact_cuts", impact_cuts);
  visit("closing_length", closing_length);
  visit("slip_end_cuts", slip_end_cuts);
  visit("overlap", overlap);
  visit("penetration_slop", penetration_slop);
  visit("sticking_penalty", sticking_penalty);
  visit("sliding_penalty", sliding_penalty);
  visit("refit_share", refit_share);
}

/// The same; an `Effort` is a value too.
template <class Visit>
void visit_fields(const NativeOptions& options, Visit visit) {
  const auto& [steps_per_second, small_island, large_island, rest_tolerance, missed_contact_overlap, sleep, jump,
               freeze] = options;
  visit("steps_per_second", steps_per_second);
  visit("small_island", small_island);
  visit("large_island", large_island);
  visit("rest_tolerance", rest_tolerance);
  visit("missed_contact_overlap", missed_contact_overlap);
  visit("sleep", sleep);
  visit("jump", jump);
  visit("freeze", freeze);
}

}  // namespace holdfast::internal::native
