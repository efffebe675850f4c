#include "core/native/native_options.hpp"

#include <algorithm>

namespace holdfast::internal::native {

NativeOptions native_options(const Settings& settings) {
  const NativeSettings& given = settings.native;
  NativeOptions options;
  switch (given.accuracy) {
    case Accuracy::screening:
      options.steps_per_second = 60.0;
      options.large_island = {.tolerance = 1e-3,
                              .reset_tolerance = 1e-6,
                              .iterations = 12,
                              .reset_iterations = 16,
                              .mean_residual = 0.1,
                              .impact_cuts = 2,
                              .closing_length = 2e-3,
                              .slip_end_cuts = 0,
                              .overlap = 7.5e-4,
                              .penetration_slop = 1e-4,
                              .sticking_penalty = kLargeIslandStickingPenalty,
                              .sliding_penalty = kLargeIslandSlidingPenalty,
                              .refit_share = kLargeIslandRefitShare};
      options.small_island.overlap = 2e-4;
      options.small_island.iterations = 30;
      options.rest_tolerance = 1e-6;
      options.missed_contact_overlap = 1e-3;
      break;
    case Accuracy::standard:
      break;
    case Accuracy::reference:
      options.steps_per_second = 1440.0;
      options.small_island = {.tolerance = 1e-9,
                              .reset_tolerance = 1e-14,
                              .iterations = 400,
                              .reset_iterations = 4000,
                              .impact_cuts = 32,
                              .slip_end_cuts = 32,
                              .sliding_penalty = kSlidingPenalty};
      // Below about 1e-3 of |g − a| h, the velocities of a jammed crowd are not determined.
      options.large_island = {.tolerance = 1e-6,
                              .reset_tolerance = 1e-9,
                              .iterations = 100,
                              .reset_iterations = 400,
                              .mean_residual = 1e-3,
                              .impact_cuts = 2,
                              .slip_end_cuts = 0,
                              .sliding_penalty = kSlidingPenalty};
      options.rest_tolerance = 1e-9;
      options.sleep = false;
      break;
  }
  options.steps_per_second =
      given.steps_per_second.value_or(settings.steps_per_second.value_or(options.steps_per_second));
  for (Effort* effort : {&options.small_island, &options.large_island}) {
    if (given.tolerance) {
      effort->tolerance = *given.tolerance;
      effort->reset_tolerance = 1e-3 * *given.tolerance;
    }
    effort->iterations = given.iterations.value_or(effort->iterations);
    effort->reset_iterations = std::max(effort->reset_iterations, effort->iterations);
    effort->impact_cuts = given.impact_cuts.value_or(effort->impact_cuts);
  }
  options.rest_tolerance = given.rest_tolerance.value_or(options.rest_tolerance);
  options.sleep = given.sleep.value_or(options.sleep);
  options.jump = given.jump;
  options.freeze = given.freeze;
  return options;
}

}  // namespace holdfast::internal::native
