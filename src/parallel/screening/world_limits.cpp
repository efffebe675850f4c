#include "parallel/screening/world_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/engine/journey.hpp"

namespace holdfast::internal {

namespace {

/// Fraction of a step that is taken for rounding, as where steps are planned.
constexpr double kStepSlack = 1e-6;

std::string at_most(double number) {
  return fmt::format("at most {:.0f}: a longer ResultsIntervallInSeconds, less RunOutSeconds, or --no-series", number);
}

}  // namespace

double most_steps(const Acceleration& acceleration, const Settings& settings, double steps_per_second) {
  return (settings.screening.settle_seconds + latest_end(acceleration, settings)) * steps_per_second;
}

std::optional<Error> check_steps(const std::string& path, const Acceleration& acceleration, const Settings& settings,
                                 double steps_per_second) {
  const double steps = std::ceil(most_steps(acceleration, settings, steps_per_second) - kStepSlack);
  if (steps <= kMostSteps) return std::nullopt;
  // With digits that tell one step too many from the limit, and a power of ten where the number is absurd.
  return Error{.file = path,
               .what = "would take a world too many steps",
               .value = fmt::format("{:.10g}", steps),
               .accepted = fmt::format("at most {:.0f}: fewer steps per second, or a shorter time", kMostSteps)};
}

double most_samples(const Acceleration& acceleration, const Settings& settings) {
  const double longest = std::max(latest_end(acceleration, settings), settings.screening.settle_seconds);
  return std::floor(longest / settings.results_interval) + 2.0;
}

std::optional<Error> check_samples(const std::string& path, const Acceleration& acceleration,
                                   const Settings& settings) {
  const double samples = most_samples(acceleration, settings) - 2.0;
  if (samples <= kMostSamples) return std::nullopt;
  return Error{.file = path,
               .what = "would give a world too many samples",
               .value = fmt::format("{:.0f}", samples),
               .accepted = at_most(kMostSamples)};
}

std::optional<Error> check_rows(const std::string& layout, std::size_t boxes, const Acceleration& acceleration,
                                const Settings& settings) {
  const double samples = most_samples(acceleration, settings);
  const double rows = samples * static_cast<double>(boxes);
  if (rows <= kMostRows) return std::nullopt;
  return Error{.file = layout,
               .what = fmt::format("its series under {} would be too large, {:.0f} samples of {} boxes",
                                   acceleration.name, samples, boxes),
               .value = fmt::format("{:.0f}", rows),
               .accepted = at_most(kMostRows)};
}

}  // namespace holdfast::internal
