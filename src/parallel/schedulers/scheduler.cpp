#include "parallel/schedulers/scheduler.hpp"

#include <oneapi/tbb/info.h>

namespace holdfast {

std::optional<Scheduler> scheduler_of(std::string_view name) {
  if (name == "tbb") return Scheduler::tbb;
#ifdef _OPENMP
  if (name == "openmp") return Scheduler::openmp;
#endif
  if (name == "serial") return Scheduler::serial;
  return std::nullopt;
}

std::vector<std::string> scheduler_names() {
#ifdef _OPENMP
  return {"tbb", "openmp", "serial"};
#else
  return {"tbb", "serial"};
#endif
}

int thread_count(int wanted) { return wanted > 0 ? wanted : tbb::info::default_concurrency(); }

}  // namespace holdfast
