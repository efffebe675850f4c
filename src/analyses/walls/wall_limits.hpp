#pragma once

#include <array>
#include <optional>

#include "core/model/settings.hpp"
#include "core/model/side_impulse.hpp"

namespace holdfast::internal {

/// The forces that a norm tests the sides of a vehicle body or container with, outwards, N; NaN where it has none.
/// docs/guide/walls.md has the sources.
/// @param payload weight of the load, N
std::array<double, kPushedCount> wall_limits(std::optional<WallNorm> norm, double payload);

}  // namespace holdfast::internal
