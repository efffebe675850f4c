#pragma once

#include <string>
#include <vector>

#include "validate/laboratory/laboratory.hpp"

namespace holdfast::internal {

/// The engines and settings that are validated: the points in the plot of speed against error. The first setting of
/// each engine is its default.
const std::vector<EngineSetting>& engine_settings();

/// Whether errors of an engine with a setting are held to recorded bounds: those of `native` at all accuracies, and of
/// every other engine with its default. The other settings are points of the plot.
bool has_bounds(const std::string& engine, const std::string& setting);

}  // namespace holdfast::internal
