#pragma once

#include <atomic>

#include "app/exit_code.hpp"
#include "core/engine/run_observer.hpp"

namespace holdfast::internal {

/// What signals have asked of a run so far. One for the process, since signals are.
///
/// The first SIGINT (Ctrl-C) asks to hand out no more work and to finish what is in flight; a second one, or
/// SIGTERM, to drop it. What finished is kept in every case.
struct StopSignal : StopRequest {
  std::atomic<int> signal = 0;  ///< the first signal; 0 while there was none
};

/// Routes SIGINT and SIGTERM to the process's request, and returns it.
const StopSignal& watch_stop_signals();

/// The exit code of what a signal has stopped.
ExitCode exit_code_of(const StopSignal& stop);

/// Gives SIGINT and SIGTERM their usual effect again: they end the process.
void unwatch_stop_signals();

}  // namespace holdfast::internal
