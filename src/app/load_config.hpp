#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "io/input/config_reader.hpp"

namespace holdfast::internal {

/// Reads a config.ini; warnings go to standard error. Defaults without a path.
Result<Config> load_config(const std::optional<std::string>& path);

}  // namespace holdfast::internal
