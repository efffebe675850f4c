#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Removes what an earlier run left of the results file `path`: the file, its parts, and temporary files. Nothing else
/// is touched: an error when `path` is neither HDF5 nor empty. The caller holds the `OutputLock`.
std::optional<Error> remove_results(const std::string& path);

}  // namespace holdfast::internal
