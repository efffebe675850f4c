#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/result.hpp"
#include "core/engine/result_sink.hpp"
#include "core/engine/world_record.hpp"

namespace holdfast::internal {

/// How far a run has come. Counted by the writing thread; any thread may read it.
struct RunProgress {
  std::uint64_t total = 0;               ///< worlds of the run
  std::uint64_t resumed = 0;             ///< of these, finished by an earlier run
  std::atomic<std::uint64_t> done = 0;   ///< finished, the resumed ones included
  std::atomic<std::uint64_t> steps = 0;  ///< of the worlds finished in this run
  std::atomic<std::uint64_t> steps_skipped = 0;
};

/// Asks a run to end early. Set by any thread, or by a signal handler.
struct StopRequest {
  std::atomic<bool> no_more = false;  ///< hand out nothing more, and finish what is in flight
  std::atomic<bool> drop = false;     ///< drop what is in flight as well; only together with `no_more`
};

/// Watches a run: a terminal, a test, or nobody. Calls come from different threads, one at a time and in the order of
/// the run; they hold up the run while they last. None may throw anything but `std::bad_alloc`, which ends the run.
class RunObserver {
 public:
  RunObserver() = default;
  RunObserver(const RunObserver&) = delete;
  RunObserver& operator=(const RunObserver&) = delete;
  virtual ~RunObserver() = default;

  /// Called once, before the first world is simulated. `progress` may be read until `ended` is called.
  virtual void started(const RunProgress& /*progress*/) {}

  /// What is odd about an input and does not keep it from being used.
  virtual void warned(const Error& /*warning*/) {}

  /// A layout that can be used, before its first world is finished; one that an earlier run began has boxes with their
  /// names alone.
  virtual void layout_begins(const LayoutRecord& /*layout*/) {}

  /// What analyses find of a layout is found, in a run that was asked for such. Called before its first world is
  /// finished.
  virtual void layout_finished(const LayoutRecord& /*layout*/) {}

  /// A world is simulated and handed over to the sink, or was finished by an earlier run. In the order of the run.
  /// @param index of the world in the run
  virtual void world_finished(const WorldRecord& /*world*/, std::size_t /*index*/) {}

  /// Called once, after the last world, however the run ends.
  virtual void ended() {}
};

}  // namespace holdfast::internal
