#pragma once

#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// The forces on the walls of a results file for a reader at a terminal: per layout the largest on each wall, as shares
/// of the norm's limit where the run was asked for one, with the wall that is pressed most and the acceleration. Empty
/// where the run was not asked for wall forces. Lines, each with a newline at the end.
Result<std::string> wall_table(const std::string& results_path);

}  // namespace holdfast::internal
