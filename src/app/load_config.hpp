#pragma once

#include <optional>
#include <string>

#include "core/result.hpp"
#include "io/config_reader.hpp"

namespace holdfast {

/// Reads a config.ini; warnings go to standard error. Defaults without a path.
Result<Config> load_config(const std::optional<std::string>& path);

}  // namespace holdfast
