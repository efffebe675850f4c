#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Removes the files of an earlier run at `path`: the results file, its parts, and temporary files. Nothing else is
/// removed: an error if `path` is neither HDF5 nor empty. The caller holds the `OutputLock`.
std::optional<Error> remove_results(const std::string& path);

}  // namespace holdfast::internal
