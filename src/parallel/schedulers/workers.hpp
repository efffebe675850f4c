#pragma once

#include <oneapi/tbb/task_arena.h>

#include "core/model/settings.hpp"
#include "parallel/schedulers/scheduler.hpp"

namespace holdfast::internal {

/// Threads that work on one run after the other. None is started before the first run that needs several; used by one
/// run at a time.
class Workers {
 public:
  /// @param threads as `thread_count` takes it
  Workers(Scheduler scheduler, int threads)
      : scheduler_(scheduler), threads_(thread_count(threads)), arena_(threads_) {}

  Scheduler scheduler() const { return scheduler_; }
  int threads() const { return threads_; }
  /// Where TBB's tasks of a run are spread over the threads.
  tbb::task_arena& arena() { return arena_; }

 private:
  Scheduler scheduler_;
  int threads_;
  tbb::task_arena arena_;
};

}  // namespace holdfast::internal
