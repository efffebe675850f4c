#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "parallel/screening/stage_costs.hpp"

namespace holdfast::internal {

/// Writes the seconds as a JSON object, one key per stage, into a new file or over an old one.
std::optional<Error> write_stage_seconds(const StageSeconds& seconds, const std::string& path);

/// What keeps `write_stage_seconds` from writing there, if anything.
std::optional<Error> check_costs_file(const std::string& path);

/// Reads what `write_stage_seconds` wrote.
Result<StageSeconds> read_stage_seconds(const std::string& path);

}  // namespace holdfast::internal
