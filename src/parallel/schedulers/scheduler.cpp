#include "parallel/schedulers/scheduler.hpp"

#include <oneapi/tbb/info.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>

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

bool may_use_threads() {
  static std::atomic<pid_t> first_user = 0;
  const pid_t self = getpid();
  pid_t user = 0;
  return first_user.compare_exchange_strong(user, self) || user == self;
}

}  // namespace holdfast::internal
