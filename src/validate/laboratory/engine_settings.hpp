#pragma once

#include <vector>

#include "validate/laboratory/laboratory.hpp"

namespace holdfast::internal {

/// The engines and settings that are validated: the points in the plot of speed against error. The first setting of
/// each engine is its default.
const std::vector<EngineSetting>& engine_settings();

}  // namespace holdfast::internal
