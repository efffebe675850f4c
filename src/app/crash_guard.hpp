#pragma once

#include <functional>
#include <string>

#include "app/exit_code.hpp"

namespace holdfast::internal {

/// Does work that reads an HDF5 file of unknown origin in a process of its own, and passes on its exit code.
///
/// HDF5 1.10 trusts what the file says of itself: a single wrong byte can make it read beyond a buffer. When the child
/// crashes, the parent lives, says that `path` is damaged, and returns `bad_usage`. Only for a process that has one
/// thread. What the work changes in memory is lost.
/// @param cure what to do about a damaged file
ExitCode guard_reading(const std::string& path, const std::function<ExitCode()>& work, const std::string& cure);

}  // namespace holdfast::internal
