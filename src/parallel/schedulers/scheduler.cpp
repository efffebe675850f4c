#include "parallel/schedulers/scheduler.hpp"

#include <oneapi/tbb/info.h>

namespace holdfast::internal {

std::vector<std::string> scheduler_names() {
#ifdef _OPENMP
  return {"tbb", "openmp", "serial"};
#else
  return {"tbb", "serial"};
#endif
}

std::optional<Error> why_not_built([[maybe_unused]] Scheduler scheduler) {
#ifndef _OPENMP
  if (scheduler == Scheduler::openmp)
    return Error{.what = "unknown scheduler", .value = "openmp", .accepted = "accepted are tbb, serial"};
#endif
  return std::nullopt;
}

int thread_count(int wanted) { return wanted > 0 ? wanted : tbb::info::default_concurrency(); }

}  // namespace holdfast::internal
