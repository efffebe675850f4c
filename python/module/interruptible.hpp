#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <holdfast/holdfast.hpp>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace holdfast::python {

/// How often Python's signals are looked at, so that Ctrl-C seems to work at once.
inline constexpr std::chrono::milliseconds kSignalInterval{50};

/// Work on a thread of its own, for which the calling thread waits.
template <class Work>
class WaitedFor {
 public:
  explicit WaitedFor(Work& work) : thread_([this, &work] { run(work); }) {}
  WaitedFor(const WaitedFor&) = delete;
  WaitedFor& operator=(const WaitedFor&) = delete;
  ~WaitedFor() { thread_.join(); }

  /// Whether the work is done, after so much time at most.
  bool done_within(std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, wait, [this] { return done_; });
  }

  /// Throws what the work threw.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void run(Work& work) {
    try {
      work();
    } catch (...) {
      error_ = std::current_exception();
    }
    const std::scoped_lock lock(mutex_);
    done_ = true;
    ended_.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // last: the others are there when it starts
};

/// Runs work that a screen does, without Python's lock. On Python's main thread, which is the one that gets signals,
/// they are looked at meanwhile: an exception that comes of one, such as KeyboardInterrupt, cancels the work and is
/// raised when it has ended.
template <class Work>
void run_interruptible(Screen& screen, bool on_main_thread, Work work) {
  std::optional<WaitedFor<Work>> waited_for;
  if (on_main_thread) {
    try {
      waited_for.emplace(work);
    } catch (const std::system_error&) {
      // No thread is to be had: the work is done here.
    }
  }
  if (!waited_for) {
    const pybind11::gil_scoped_release released;
    work();
    return;
  }
  bool interrupted = false;
  for (bool done = false; !done;) {
    {
      const pybind11::gil_scoped_release released;
      done = waited_for->done_within(kSignalInterval);
    }
    if (!done && !interrupted) interrupted = PyErr_CheckSignals() != 0;
    if (!done && interrupted) screen.cancel();
  }
  if (interrupted) throw pybind11::error_already_set();
  waited_for->rethrow();
}

}  // namespace holdfast::python
