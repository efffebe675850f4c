#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "app/report.hpp"

namespace holdfast::internal {

namespace {

constexpr std::chrono::seconds kPlainInterval(10);

std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(0.0, seconds)));
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

std::string progress_text(const RunProgress& progress, const char* noun, double seconds) {
  const std::uint64_t done = progress.done;
  std::string text = fmt::format("{}/{} {}", done, progress.total, noun);
  const std::uint64_t here = done - progress.resumed;
  if (here == 0 || seconds <= 0.0) return text;
  const double rate = static_cast<double>(here) / seconds;
  text += fmt::format("  {:.{}f} {}/s", rate, rate < 10.0 ? 2 : 0, noun);
  const std::uint64_t steps = progress.steps;
  if (steps > 0) {
    const double skipped = 100.0 * static_cast<double>(progress.steps_skipped) / static_cast<double>(steps);
    text += fmt::format("  {:.0f} % of steps skipped", skipped);
  }
  return text + fmt::format("  {} to go", clock_text(static_cast<double>(progress.total - done) / rate));
}

ProgressLine::ProgressLine(const RunProgress& progress, const char* noun, std::FILE* stream, bool quiet)
    : progress_(progress), noun_(noun), stream_(stream), quiet_(quiet), terminal_(isatty(fileno(stream)) == 1) {}

ProgressLine::~ProgressLine() { wipe(); }

void ProgressLine::show() {
  if (quiet_) return;
  const auto now = std::chrono::steady_clock::now();
  const std::string text = progress_text(progress_, noun_, std::chrono::duration<double>(now - start_).count());
  if (terminal_) {
    const std::size_t blanks = drawn_ > text.size() ? drawn_ - text.size() : 0;
    print_to(stream_, "\r{}{:{}}", text, "", blanks);
    std::fflush(stream_);
    drawn_ = text.size();
  } else if (now - last_ >= kPlainInterval) {
    print_to(stream_, "{}\n", text);
    std::fflush(stream_);
    last_ = now;
  }
}

void ProgressLine::note(const std::string& text) {
  wipe();
  print_to(stream_, "{}\n", text);
  std::fflush(stream_);
}

void ProgressLine::wipe() {
  if (drawn_ == 0) return;
  print_to(stream_, "\r{:{}}\r", "", drawn_);
  std::fflush(stream_);
  drawn_ = 0;
}

}  // namespace holdfast::internal
