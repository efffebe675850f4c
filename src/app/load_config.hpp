#pragma once

#include <string>

#include "core/result.hpp"
#include "io/config_reader.hpp"

namespace holdfast {

/// Reads a config.ini; warnings go to standard error. Defaults when the path is empty.
Result<Config> load_config(const std::string& path);

}  // namespace holdfast
