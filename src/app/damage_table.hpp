#pragma once

#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// What impacts did to the boxes of a results file for a reader at a terminal: per layout the most boxes beyond the
/// damage boundary, and the largest acceleration and velocity change of a box, over all accelerations. Empty where the
/// run was not asked for damage. Lines, each with a newline at the end.
Result<std::string> damage_table(const std::string& results_path);

}  // namespace holdfast::internal
