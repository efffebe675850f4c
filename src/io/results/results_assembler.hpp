#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "io/results/run_description.hpp"

namespace holdfast::internal {

/// Assembles the results file `path` from the finished parts in `<path>.parts/`, and removes the parts. The file gets
/// its name only when all of it is on disk; after an error the parts are still there. The bytes of the file do not
/// depend on where parts end.
/// @param stop checked repeatedly, if given; when it is set, nothing is changed, and an error is returned
std::optional<Error> assemble(const std::string& path, const RunDescription& run,
                              const std::atomic<bool>* stop = nullptr);

}  // namespace holdfast::internal
