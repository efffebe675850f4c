#include "validate/laboratory/engine_settings.hpp"

#include <algorithm>

#include "core/native/native_options.hpp"

namespace holdfast::internal {

namespace {

/// Bullet with a step, a number of iterations, and either Bullet's default friction (1F: one direction, fixed order) or
/// 2F R (two directions, random order).
EngineSetting bullet(const char* engine, const char* name, double steps_per_second, int iterations,
                     bool quick = false) {
  return {engine, name,
          [=](Settings& settings) {
            settings.steps_per_second = steps_per_second;
            settings.bullet.iterations = iterations;
          },
          quick};
}

/// The native engine at one of its accuracies; the arguments say whether it is part of a quick run and of the load
/// suite.
EngineSetting native_setting(const char* name, Accuracy accuracy, bool quick, bool loads) {
  return {.engine = "native",
          .name = name,
          .choose =
              [=](Settings& settings) {
                settings.native.accuracy = accuracy;
                settings.steps_per_second = native::native_options(settings).steps_per_second;
              },
          .quick = quick,
          .loads = loads};
}

/// Bullet's OpenCL pipeline with a step and a number of iterations; not part of a quick run.
EngineSetting opencl(const char* name, double steps_per_second, int iterations) {
  return {.engine = "bullet-opencl",
          .name = name,
          .choose =
              [=](Settings& settings) {
                settings.steps_per_second = steps_per_second;
                settings.opencl.iterations = iterations;
              },
          .loads = false,
          .quick_cases_only = true};
}

}  // namespace

const std::vector<EngineSetting>& engine_settings() {
  static const std::vector<EngineSetting> kSettings = {
      native_setting("standard", Accuracy::standard, true, true),
      native_setting("screening", Accuracy::screening, true, true),
      native_setting("reference", Accuracy::reference, false, false),
      bullet("bullet", "240 Hz, 50 it", 240, 50, true),
      bullet("bullet", "60 Hz, 10 it", 60, 10),
      bullet("bullet", "480 Hz, 50 it", 480, 50),
      bullet("bullet-f64", "240 Hz, 50 it", 240, 50),
      bullet("bullet-f64", "1000 Hz, 50 it", 1000, 50),
      bullet("bullet-stock", "240 Hz, 10 it", 240, 10, true),
      bullet("bullet-stock", "1000 Hz, 10 it", 1000, 10),
      opencl("240 Hz, 20 it", 240, 20),
  };
  return kSettings;
}

bool has_bounds(const std::string& engine, const std::string& setting) {
  const std::vector<EngineSetting>& settings = engine_settings();
  const auto first = std::find_if(settings.begin(), settings.end(),
                                  [&](const EngineSetting& candidate) { return candidate.engine == engine; });
  return engine == "native" || (first != settings.end() && first->name == setting);
}

}  // namespace holdfast::internal
