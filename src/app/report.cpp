#include "app/report.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>

namespace holdfast::internal {

void write_to(std::FILE* stream, std::string_view text) {
  // What is not written shows in the stream's error state.
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stream));
}

void write_unless(const std::atomic<bool>& stop, std::FILE* stream, std::string_view text) {
  constexpr int kPatience = 100;  // between two looks at `stop`, ms
  while (!text.empty()) {
    pollfd reader = {::fileno(stream), POLLOUT, 0};
    while (::poll(&reader, 1, kPatience) <= 0)
      if (stop) return;
    // A pipe that takes anything takes as much as this at once.
    const std::string_view piece = text.substr(0, PIPE_BUF);
    write_to(stream, piece);
    std::fflush(stream);
    text.remove_prefix(piece.size());
  }
}

void meet_the_callers_limits() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDONLY));
  std::signal(SIGXFSZ, SIG_IGN);
}

ExitCode checked_output(ExitCode code) {
  const bool flushed = std::fflush(stdout) == 0;
  const char* reason = flushed ? "some of it was lost" : std::strerror(errno);
  if (flushed && std::ferror(stdout) == 0) return code;
  fail(code, {.file = "standard output", .what = "cannot be written", .value = reason});
  return code == ExitCode::done ? ExitCode::some_failed : code;
}

ExitCode fail(ExitCode code, std::span<const Error> errors) {
  for (const Error& error : errors) print_to(stderr, "{}\n", error.message());
  return code;
}

ExitCode fail(ExitCode code, const Error& error) { return fail(code, std::span(&error, 1)); }

void warn(std::span<const Error> warnings) {
  for (const Error& warning : warnings) print_to(stderr, "warning: {}\n", warning.message());
}

}  // namespace holdfast::internal
