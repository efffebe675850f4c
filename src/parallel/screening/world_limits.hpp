#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "core/model/acceleration.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Most samples of a world.
inline constexpr double kMostSamples = 200'000;

/// Most rows of a world's series, samples times boxes: 68 bytes each, 1.4 GB, all of which waits in memory for the
/// world's end.
inline constexpr double kMostRows = 20'000'000;

/// Most steps of a world, which take days, and how many are worth a warning, since they take minutes.
inline constexpr double kMostSteps = 1e9, kManySteps = 1e7;

/// Steps of a world under an acceleration, at most, where it settles and runs out for as long as it may.
double most_steps(const Acceleration& acceleration, const Settings& settings, double steps_per_second);

/// What a world under the acceleration would take too many steps for, if it does.
std::optional<Error> check_steps(const std::string& path, const Acceleration& acceleration, const Settings& settings,
                                 double steps_per_second);

/// Samples of a world under an acceleration, at most: one at the begin and one at the end besides those in between, of
/// settling or from t = 0 on.
double most_samples(const Acceleration& acceleration, const Settings& settings);

/// What the series of an acceleration would be too long for, if they are.
std::optional<Error> check_samples(const std::string& path, const Acceleration& acceleration, const Settings& settings);

/// What the series of a world of so many boxes would be too large for, if they are.
/// @param layout path or name of the world's layout
std::optional<Error> check_rows(const std::string& layout, std::size_t boxes, const Acceleration& acceleration,
                                const Settings& settings);

}  // namespace holdfast::internal
