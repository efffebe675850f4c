#include "core/native/native_options.hpp"

#include <algorithm>

namespace holdfast::internal::native {

NativeOptions native_options(const Settings& settings) {
  const NativeSettings& given = settings.native;
  NativeOptions options;
  switch (given.accuracy) {
    case Accuracy::screening:
      options.steps_per_second = 60.0;
      options.crowd = {.tolerance = 1e-3,
                       .cold_tolerance = 1e-6,
                       .iterations = 8,
                       .cold_iterations = 60,
                       .mean_residual = 0.05,
                       .impact_cuts = 0,
                       .impact_length = 2e-3,
                       .stop_cuts = 0,
                       .overlap = 5e-4,
                       .late_overlap = 1e-4};
      options.few.overlap = 2e-4;
      options.rest_tolerance = 1e-6;
      options.rest_iterations = 3000;
      options.deep_overlap = 1e-3;
      break;
    case Accuracy::standard:
      break;
    case Accuracy::reference:
      options.steps_per_second = 1440.0;
      options.few = options.crowd = {.tolerance = 1e-9,
                                     .cold_tolerance = 1e-14,
                                     .iterations = 400,
                                     .cold_iterations = 4000,
                                     .impact_cuts = 32,
                                     .impact_length = 0.0,
                                     .stop_cuts = 32};
      options.rest_tolerance = 1e-9;
      options.rest_iterations = 4000;
      break;
  }
  options.steps_per_second =
      given.steps_per_second.value_or(settings.steps_per_second.value_or(options.steps_per_second));
  for (Effort* effort : {&options.few, &options.crowd}) {
    if (given.tolerance) {
      effort->tolerance = *given.tolerance;
      effort->cold_tolerance = 1e-3 * *given.tolerance;
    }
    effort->iterations = given.iterations.value_or(effort->iterations);
    effort->cold_iterations = std::max(effort->cold_iterations, effort->iterations);
    effort->impact_cuts = given.impact_cuts.value_or(effort->impact_cuts);
  }
  options.rest_tolerance = given.rest_tolerance.value_or(options.rest_tolerance);
  options.jump = given.jump;
  options.freeze = given.freeze;
  return options;
}

}  // namespace holdfast::internal::native
