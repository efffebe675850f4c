#pragma once

#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// The margins of a results file for a reader at a terminal: the layouts that stand least first, with the weakest
/// direction and the box that goes first there. In a run with a norm, beside what the norm needs. Empty where the run
/// was not asked for margins. Lines, each with a newline at the end.
Result<std::string> margin_table(const std::string& results_path);

}  // namespace holdfast::internal
