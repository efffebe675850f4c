#include "app/reading_guard.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>

#include "app/report.hpp"
#include "io/results/results_reader.hpp"

namespace holdfast::internal {

namespace {

/// Processor time that a call of HDF5 may take, s for each thread. 512 MB of data take about two.
constexpr int kPatience = 10;

/// Exit status of a child for which there was no memory; no exit code of the program.
constexpr int kRanOut = 99;

std::atomic<pid_t> child = 0;

/// Passes on what was sent to this process alone; Ctrl-C in a terminal reaches both.
extern "C" void pass_on(int signal, siginfo_t* sent, void* /*context*/) {
  if (sent->si_code == SI_USER) kill(child, signal);
}

std::uint64_t calls_before = 0;

/// Called after each `kPatience` of processor time: the process ends if no call has returned in between.
extern "C" void look_for_progress(int signal) {
  const std::uint64_t now = results_calls_returned();
  if (now == calls_before) {
    std::signal(signal, SIG_DFL);
    raise(signal);
  }
  calls_before = now;
}

/// Bytes of memory that this process may write to.
rlim_t memory_now() {
  std::ifstream pages("/proc/self/statm");
  rlim_t size = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
  pages >> size >> resident >> shared >> text >> library >> data;
  return data * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void limit(const GuardedFile& file) {
  const auto threads = static_cast<rlim_t>(file.threads);
  const rlim_t bytes = memory_now() + threads * (static_cast<rlim_t>(file.memory) << 20U);
  const rlimit data = {bytes, bytes};
  setrlimit(RLIMIT_DATA, &data);
  std::set_new_handler([] { _exit(kRanOut); });
  // How the library ends when a small allocation of its own fails.
  std::set_terminate([] { _exit(kRanOut); });
  calls_before = results_calls_returned();
  std::signal(SIGPROF, look_for_progress);
  const timeval interval = {kPatience * file.threads, 0};
  const itimerval timer = {interval, interval};
  setitimer(ITIMER_PROF, &timer, nullptr);
}

[[noreturn]] void work_in_child(const GuardedFile& file, const std::function<ExitCode()>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // a parent that is killed takes its child along
  limit(file);
  ExitCode code = ExitCode::some_failed;
  try {
    code = work();
  } catch (const std::exception& exception) {
    fail(code, {.file = file.path, .what = "cannot be read", .value = exception.what()});
  }
  code = checked_output(code);
  std::fflush(nullptr);
  _exit(static_cast<int>(code));
}

/// The child's status once it has ended.
int wait_for_child() {
  struct sigaction action = {};
  action.sa_sigaction = pass_on;
  action.sa_flags = SA_RESTART | SA_SIGINFO;
  struct sigaction interrupt = {};
  struct sigaction terminate = {};
  sigaction(SIGINT, &action, &interrupt);
  sigaction(SIGTERM, &action, &terminate);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  sigaction(SIGINT, &interrupt, nullptr);
  sigaction(SIGTERM, &terminate, nullptr);
  return status;
}

/// What is wrong with a file when the process that read it has ended by a signal; null: nothing, somebody sent it.
const char* what_killed(int signal) {
  switch (signal) {
    case SIGSEGV:
    case SIGBUS:
    case SIGABRT:
    case SIGFPE:
      return "is damaged: the HDF5 library crashed on it";
    case SIGPROF:
      return "is damaged: the HDF5 library does not come to an end with it";
    default:
      return nullptr;
  }
}

}  // namespace

void reading_has_ended() {
  const itimerval none = {};
  setitimer(ITIMER_PROF, &none, nullptr);
}

ExitCode guard_reading(const GuardedFile& file, const std::function<ExitCode()>& work) {
  std::fflush(nullptr);  // or both would print what is still in the buffers
  child = fork();
  if (child == 0) work_in_child(file, work);
  if (child < 0)
    return fail(ExitCode::some_failed, {.file = file.path, .what = "cannot be read", .value = std::strerror(errno)});
  const int status = wait_for_child();
  if (WIFEXITED(status)) {
    if (WEXITSTATUS(status) != kRanOut) return static_cast<ExitCode>(WEXITSTATUS(status));
    return fail(ExitCode::bad_usage,
                {.file = file.path,
                 .what = fmt::format("takes more than {} MB of memory to be read", file.memory * file.threads),
                 .accepted = fmt::format("if the file is to be trusted, --memory {} allows more", 8 * file.memory)});
  }
  const int signal = WTERMSIG(status);
  if (const char* reason = what_killed(signal))
    return fail(ExitCode::bad_usage, {.file = file.path, .what = reason, .accepted = file.cure});
  // Somebody killed the child: this process ends in the same way.
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  return ExitCode::some_failed;
}

}  // namespace holdfast::internal
