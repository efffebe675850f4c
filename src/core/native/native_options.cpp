#include "core/native/native_options.hpp"

#include <algorithm>

namespace holdfast::internal::native {

NativeOptions native_options(const Settings& settings) {
  const NativeSettings& given = settings.native;
  NativeOptions options;
  switch (given.accuracy) {
    case Accuracy::screening:
      options.steps_per_second = 60.0;
      options.small_island.slop = 2e-4;
      options.large_island.tolerance = 1e-3;
      options.large_island.mean_residual = 0.1;
      options.large_island.slop = 1e-3;
      break;
    case Accuracy::standard:
      break;
    case Accuracy::reference:
      options.steps_per_second = 1440.0;
      options.small_island.tolerance = 1e-9;
      options.small_island.iterations = 100;
      options.small_island.impact_cuts = options.small_island.slip_end_cuts = 32;
      // Below about 1e-3 of |g − a| h, the velocities of a jammed crowd are not determined.
      options.large_island.tolerance = 1e-6;
      options.large_island.iterations = 100;
      options.large_island.slop = options.small_island.slop;
      options.sleep = false;
      break;
  }
  options.steps_per_second =
      given.steps_per_second.value_or(settings.steps_per_second.value_or(options.steps_per_second));
  for (Effort* effort : {&options.small_island, &options.large_island}) {
    effort->tolerance = given.tolerance.value_or(effort->tolerance);
    effort->iterations = given.iterations.value_or(effort->iterations);
    effort->impact_cuts = given.impact_cuts.value_or(effort->impact_cuts);
    effort->reset_tolerance = kNegligible * effort->tolerance;
  }
  options.small_island.reset_iterations = kResetIterations * options.small_island.iterations;
  options.large_island.reset_iterations = 2 * options.large_island.iterations;
  options.large_island.penetration_slop = std::min(0.5 * options.large_island.slop, 2.0 * kFlushWidth);
  options.rest_tolerance = given.rest_tolerance.value_or(options.rest_tolerance);
  options.sleep = given.sleep.value_or(options.sleep);
  // A world that ends by sleeping counts how long its boxes rest.
  options.jump = given.jump && settings.stopping_condition != StoppingCondition::sleeping;
  options.freeze = given.freeze;
  return options;
}

}  // namespace holdfast::internal::native
