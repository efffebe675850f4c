#pragma once

#include <string>

#include "core/model/settings.hpp"
#include "io/loads/read_load.hpp"

namespace holdfast::internal {

/// Finishes a load of a file that has been read: overlaps that rounding explains are trimmed; a load that as a whole
/// does not fit, and would in another unit, with other axes or in another container, gets one error that says so; then
/// its geometry is checked (see check_layout).
/// @param path of the file, for messages
void check_load(ReadLoad& load, const std::string& path, const Settings& settings);

}  // namespace holdfast::internal
