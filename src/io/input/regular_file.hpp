#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// The reason why a file of this kind cannot be an input; only regular files can. A pipe or a device may block its
/// reader for ever, and provides its bytes only once, so that a resumed run cannot compare them.
/// @param mode from stat()
std::optional<Error> why_no_regular_file(const std::string& path, mode_t mode);

}  // namespace holdfast::internal
