#pragma once

#include <string>

#include "core/engine/world_record.hpp"
#include "core/model/verdict.hpp"

namespace holdfast::internal {

/// The line of JSON that tells a program of a finished world; units are in the names, in SI. What is not known of a
/// world that was not simulated is null.
std::string world_json(const WorldRecord& world, const std::string& layout, const std::string& acceleration,
                       std::size_t index, const Thresholds& thresholds);

}  // namespace holdfast::internal
