#pragma once

#include <string>

namespace holdfast::internal {

/// The page docs/reference/results_file.md: how to read the file, and every dataset of the schema.
std::string results_page();

}  // namespace holdfast::internal
