#pragma once

#include <string>

#include "core/engine/world_record.hpp"
#include "core/model/verdict.hpp"

namespace holdfast::internal {

/// One finished world as one line of JSON; units are in the names, in SI. Values that a world has only when it was
/// simulated are null otherwise.
/// @param time_saved as in `simulate.hpp`, s
std::string world_json(const WorldRecord& world, const std::string& layout, const std::string& acceleration,
                       std::size_t index, const Thresholds& thresholds, double time_saved);

}  // namespace holdfast::internal
