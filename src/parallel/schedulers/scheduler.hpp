#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace holdfast {

/// How work is spread over threads. Results do not depend on it.
enum class Scheduler {
  tbb,     ///< TBB's parallel pipeline: read and simulate, and compress, in parallel; one writer
  openmp,  ///< an OpenMP loop over the units; compressing and writing inside its ordered region
  serial,  ///< one after the other, on the calling thread
};

/// The scheduler of that name, if there is one.
std::optional<Scheduler> scheduler_of(std::string_view name);

/// Names of the schedulers that this build has.
std::vector<std::string> scheduler_names();

/// Threads to use when the user asks for `wanted`; 0 asks for one a core that this process may use.
int thread_count(int wanted);

}  // namespace holdfast
