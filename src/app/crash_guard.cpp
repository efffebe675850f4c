#include "app/crash_guard.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "app/report.hpp"

namespace holdfast::internal {

namespace {

bool is_crash(int signal) { return signal == SIGSEGV || signal == SIGBUS || signal == SIGABRT || signal == SIGFPE; }

/// The child's status once it has ended.
int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

ExitCode guard_reading(const std::string& path, const std::function<ExitCode()>& work, const std::string& cure) {
  std::fflush(nullptr);  // or both would print what is still in the buffers
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // a parent that is killed takes its child along
    ExitCode code = ExitCode::some_failed;
    try {
      code = work();
    } catch (const std::bad_alloc&) {
      fail(code, out_of_memory(path));
    } catch (const std::exception& exception) {
      fail(code, {.file = path, .what = "cannot be read", .value = exception.what()});
    }
    code = checked_output(code);
    std::fflush(nullptr);
    _exit(static_cast<int>(code));
  }
  if (child < 0)
    return fail(ExitCode::some_failed, {.file = path, .what = "cannot be read", .value = std::strerror(errno)});
  const int status = wait_for(child);
  if (WIFEXITED(status)) return static_cast<ExitCode>(WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (is_crash(signal))
    return fail(ExitCode::bad_usage,
                {.file = path, .what = "is damaged: the HDF5 library crashed on it", .accepted = cure});
  // Somebody killed the child: this process ends in the same way.
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  return ExitCode::some_failed;
}

}  // namespace holdfast::internal
