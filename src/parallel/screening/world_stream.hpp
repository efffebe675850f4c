#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/analysis_method.hpp"
#include "core/engine/engine.hpp"
#include "core/engine/run_inputs.hpp"
#include "core/engine/world_record.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// Layouts that are simulated while their owner goes on: handed over one by one, taken back as they finish. They wait
/// in one queue for threads that are started with the first of them. Used by one thread at a time, apart from `cancel`.
class WorldStream {
 public:
  /// A layout that is finished.
  struct Finished {
    std::uint64_t ticket = 0;
    std::vector<WorldRecord> worlds;  ///< one per acceleration; those left undone have `StopReason::not_run`
    bool cancelled = false;           ///< by `cancel`, before all worlds were done
    std::optional<Error> error;       ///< what kept its worlds from being simulated, beside a bad input
  };

  /// Which one `take` gives: the first that was finished, or the first that was submitted, once it is finished.
  enum class Order { as_finished, as_submitted };

  /// All that is named must outlive the stream. Starts no thread.
  /// @param accelerations may change while nothing is in flight
  /// @param analyses      of worlds
  /// @param on_finished   called on a thread of the stream whenever a layout is finished; may be empty. It must return
  ///                      soon, throw nothing and not call the stream
  WorldStream(const Engine& engine, const Settings& settings, const std::vector<ReadAcceleration>& accelerations,
              const AnalysisMethods& analyses, bool record_series, int threads, std::function<void()> on_finished = {});
  WorldStream(const WorldStream&) = delete;
  WorldStream& operator=(const WorldStream&) = delete;
  /// Drops what is in flight and waits for its threads.
  ~WorldStream();

  /// Hands a layout over.
  /// @param ticket names it; larger than all before
  void submit(std::uint64_t ticket, ReadLayout layout);

  /// Takes a finished layout back, and waits for it so long at most; not at all while nothing is in flight.
  std::optional<Finished> take(std::chrono::duration<double> wait, Order order);

  /// Layouts that were handed over and not taken back.
  std::size_t in_flight() const;

  /// Drops the unfinished worlds of all layouts in flight, which are finished then. May be called from any thread.
  void cancel() noexcept;

  /// True in a process that was forked after threads were started: it does not have them, and may only forget the
  /// stream without destroying it.
  bool is_of_parent() const;

 private:
  class Job;

  void start();
  void work();
  Job* next(Order order) const;

  const Engine& engine_;
  const Settings& settings_;
  const std::vector<ReadAcceleration>& accelerations_;
  AnalysisMethods analyses_;
  bool record_series_;
  int thread_count_;
  std::function<void()> on_finished_;

  mutable std::mutex mutex_;  // of all that follows, down to the threads
  std::condition_variable work_is_there_;
  std::condition_variable layout_is_finished_;
  std::map<std::uint64_t, std::shared_ptr<Job>> jobs_;  // in flight
  std::deque<std::shared_ptr<Job>> waiting_;            // of these, those that have units nobody has begun
  std::list<Job*> finished_;                            // and those that are done, in the order of their ends
  bool closing_ = false;

  std::vector<std::thread> threads_;
  long process_ = 0;  // that has the threads
};

}  // namespace holdfast::internal
