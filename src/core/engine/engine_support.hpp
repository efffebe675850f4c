#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/engine/run_inputs.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// What an engine lacks of what the settings ask for beyond its own checks, if anything: kinetic friction, and
/// forces on the sides of the container. Analyses that ask for more say so themselves.
std::optional<Error> why_unsupported(const Engine& engine, const Settings& settings);

/// Makes a layout that asks for what an engine lacks, anti-slip mats, one that cannot be used.
/// @param label what messages call the layout
/// @return what the engine lacks, if anything
std::optional<Error> refuse_unsupported(ReadLayout& layout, const Engine& engine, const std::string& label);

}  // namespace holdfast::internal
