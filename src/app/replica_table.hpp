#pragma once

#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// What the replicas of a results file say, for a reader at a terminal: per acceleration how many layouts hold, and the
/// worlds that are least certain. Empty where the run was not asked for replicas. Lines, each with a newline at the
/// end.
Result<std::string> replica_table(const std::string& results_path);

}  // namespace holdfast::internal
