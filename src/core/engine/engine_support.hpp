#pragma once

#include <optional>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// What an engine lacks of what the settings ask for beyond its own checks, if anything: kinetic friction, and the
/// analyses beside verdicts.
std::optional<Error> why_unsupported(const Engine& engine, const Settings& settings);

/// Why an engine cannot find margins, if it cannot.
std::optional<Error> why_no_margins(const Engine& engine);

}  // namespace holdfast::internal
