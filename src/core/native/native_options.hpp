#pragma once

#include <cstddef>

#include "core/model/settings.hpp"
#include "core/native/constants.hpp"

namespace holdfast::internal::native {

/// How hard the moving steps of an island are solved.
struct Effort {
  double tolerance = 1e-4;        ///< of a step's velocities, over |g − a| h
  double reset_tolerance = 1e-7;  ///< the same where the warm start is reset: the acceleration has just changed
  int iterations = 60;            ///< of a solve, at most, where its residual may pass
  int reset_iterations = 400;     ///< the same where the acceleration has just changed
  double mean_residual = 0.01;    ///< that may pass: root mean square over the points, over |g − a| h
  int impact_cuts = 8;            ///< times that impacts may cut a step
  double impact_length = 2e-4;    ///< impacts that move a body less than this within a step are not located, m
  int slip_end_cuts = 2;          ///< times that the end of a slip may cut a step
  double overlap = 1e-5;          ///< from which positions are corrected, m
  double penetration_slop = 0.0;  ///< overlap that a step may end with before a contact is solved, at least, m
  double sticking_penalty = kStickingPenalty;      ///< R, of the carried mass, along the normal and where it sticks
  double sliding_penalty = kMovingSlidingPenalty;  ///< the same along the tangents where it slides
  double refit_share = kRefitShare;                ///< of the points, above which R is fitted anew
};

/// All settings of the native engine: those of the accuracy, with the keys of the configuration that override them.
struct NativeOptions {
  double steps_per_second = 240.0;  ///< 1/s
  Effort small_island;              ///< for islands of at most `kSmallIslandBodies`
  /// For larger ones. Their impacts are solved at the end of a step: there are many at any time, and to locate them
  /// takes five times as long for no smaller error.
  Effort large_island{.iterations = 12,
                      .reset_iterations = 24,
                      .mean_residual = 0.02,
                      .impact_cuts = 0,
                      .slip_end_cuts = 0,
                      .overlap = 2e-4,
                      .penetration_slop = 1e-4,
                      .sticking_penalty = kLargeIslandStickingPenalty,
                      .sliding_penalty = kLargeIslandSlidingPenalty,
                      .refit_share = kLargeIslandRefitShare};
  double rest_tolerance = 1e-8;          ///< equilibrium residual of a body at rest, over its weight |g − a| m
  double missed_contact_overlap = 2e-4;  ///< overlap of a missed contact from which the step is halved, m
  bool sleep = true;                     ///< slow bodies of large islands that move sleep
  bool jump = true;                      ///< goes to the end of the phase where all bodies rest
  bool freeze = true;                    ///< leaves islands at rest alone until something touches them

  const Effort& effort(std::size_t bodies) const { return bodies > kSmallIslandBodies ? large_island : small_island; }
};

NativeOptions native_options(const Settings& settings);

}  // namespace holdfast::internal::native
