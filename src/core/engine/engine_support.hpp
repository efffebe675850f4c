#pragma once

#include <optional>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// What an engine lacks of what the settings ask for beyond its own checks, if anything: kinetic friction, and
/// forces on the sides of the container. Analyses that ask for more say so themselves.
std::optional<Error> why_unsupported(const Engine& engine, const Settings& settings);

}  // namespace holdfast::internal
