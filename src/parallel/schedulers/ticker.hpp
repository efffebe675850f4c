#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace holdfast::internal {

/// Calls a function at regular intervals on a thread of its own, until destroyed. A last call begins after that.
class Ticker {
 public:
  Ticker(std::chrono::milliseconds interval, std::function<void()> tick)
      : thread_([this, interval, tick = std::move(tick)](const std::stop_token& stop) {
          std::unique_lock lock(mutex_);
          // Whether the end has come is asked before the call, not after it: what happens up to the end is seen by a
          // last call, also where the end comes within one, or before the thread has begun.
          for (bool last = false; !last;) {
            wake_.wait_for(lock, stop, interval, [] { return false; });
            last = stop.stop_requested();
            tick();
          }
        }) {}

 private:
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // last: stops and joins before the rest goes
};

}  // namespace holdfast::internal
