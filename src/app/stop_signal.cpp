#include "app/stop_signal.hpp"

#include <csignal>

namespace holdfast::internal {

namespace {

StopSignal request;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "a signal handler may touch lock-free atomics only");

extern "C" void take_signal(int signal) {
  int none = 0;
  const bool first = request.signal.compare_exchange_strong(none, signal);
  if (!first || signal == SIGTERM) request.drop = true;
  request.no_more = true;
}

}  // namespace

const StopSignal& watch_stop_signals() {
  struct sigaction action = {};
  action.sa_handler = take_signal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return request;
}

ExitCode exit_code_of(const StopSignal& stop) {
  return stop.signal == SIGTERM ? ExitCode::terminated : ExitCode::interrupted;
}

void unwatch_stop_signals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace holdfast::internal
