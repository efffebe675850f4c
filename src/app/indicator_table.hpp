#pragma once

#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// What geometry alone says of the layouts of a results file, for a reader at a terminal, in the order of the file.
/// Empty where the run was not asked for indicators. Lines, each with a newline at the end.
Result<std::string> indicator_table(const std::string& results_path);

}  // namespace holdfast::internal
