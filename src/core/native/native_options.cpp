#include "core/native/native_options.hpp"

namespace holdfast::native {

NativeOptions native_options(const Settings& settings) {
  const NativeSettings& given = settings.native;
  NativeOptions options;
  switch (given.accuracy) {
    case Accuracy::screening:
      options.steps_per_second = 120.0;
      options.tolerance = 1e-3;
      options.iterations = 16;
      options.cold_iterations = 60;
      options.rest_tolerance = 1e-6;
      options.rest_iterations = 120;
      options.impact_cuts = 0;
      options.impact_length = 2e-3;
      options.overlap = 2e-4;
      options.deep_overlap = 5e-4;
      options.stop_cuts = 0;
      break;
    case Accuracy::standard:
      break;
    case Accuracy::reference:
      options.steps_per_second = 960.0;
      options.tolerance = 1e-8;
      options.iterations = 400;
      options.cold_iterations = 4000;
      options.rest_tolerance = 1e-9;
      options.rest_iterations = 4000;
      options.impact_cuts = 32;
      options.impact_length = 0.0;
      options.stop_cuts = 32;
      break;
  }
  options.steps_per_second =
      given.steps_per_second.value_or(settings.steps_per_second.value_or(options.steps_per_second));
  options.tolerance = given.tolerance.value_or(options.tolerance);
  options.iterations = given.iterations.value_or(options.iterations);
  options.rest_tolerance = given.rest_tolerance.value_or(options.rest_tolerance);
  options.impact_cuts = given.impact_cuts.value_or(options.impact_cuts);
  options.jump = given.jump;
  options.freeze = given.freeze;
  return options;
}

}  // namespace holdfast::native
