#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "io/results/run_description.hpp"

namespace holdfast::internal {

/// Makes the results file `path` of the finished parts under `<path>.parts/`, and removes the parts. The file appears
/// under its name when all of it is safe on disk; on an error the parts stay. The same worlds give the same bytes
/// wherever the parts were cut.
/// @param stop looked at now and then, if given; when set, all is left as it was, with an error
std::optional<Error> assemble(const std::string& path, const RunDescription& run,
                              const std::atomic<bool>* stop = nullptr);

}  // namespace holdfast::internal
