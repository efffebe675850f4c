#pragma once

#include <ctime>

namespace holdfast::internal {

/// Processor time that the calling thread has used, s.
inline double processor_seconds() {
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace holdfast::internal
