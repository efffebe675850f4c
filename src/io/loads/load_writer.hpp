#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/layout.hpp"

namespace holdfast::internal {

/// Loads as a text of a file, of the kind that the end of its name says: `.json` or `.jsonl`, `.csv`, `.txt`. An error
/// says what a file of that kind cannot have.
///
/// Reading it gives the same loads: numbers have as many digits as give them back. Names of loads are without the name
/// of the file they are from.
Result<std::string> loads_text(const std::vector<Layout>& loads, const std::string& path);

}  // namespace holdfast::internal
