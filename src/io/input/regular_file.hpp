#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Why something cannot be an input, by its kind: only a regular file can. A pipe or a device may keep its reader
/// waiting for ever, and gives its bytes once, so that nothing can be compared with it when a run is resumed.
/// @param mode as stat() tells it
std::optional<Error> why_no_regular_file(const std::string& path, mode_t mode);

}  // namespace holdfast::internal
