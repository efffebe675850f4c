#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Names of the schedulers that this build has.
std::vector<std::string> scheduler_names();

/// An error when this build does not have the scheduler.
std::optional<Error> why_not_built(Scheduler scheduler);

/// Threads to use when the user asks for `wanted`; 0 asks for one per core that this process may use.
int thread_count(int wanted);

/// Notes that this process runs on several threads of TBB or OpenMP. False in a process that was forked from one that
/// did: their threads are not there, their memory says that they are, and only the serial scheduler works.
bool may_use_threads();

}  // namespace holdfast::internal
