#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace holdfast {

/// How far a run has come; counted by the writing thread, read by the one that shows it.
struct ProgressCounts {
  const char* noun = "worlds";           ///< what is counted
  std::uint64_t total = 0;               ///< all of the run
  std::uint64_t resumed = 0;             ///< of these, finished by an earlier run
  std::atomic<std::uint64_t> done = 0;   ///< finished, the resumed ones included
  std::atomic<std::uint64_t> steps = 0;  ///< of the worlds finished in this run
  std::atomic<std::uint64_t> steps_skipped = 0;
};

/// The text of a progress line: done and in all, a second, share of steps skipped (when there were steps), time to go.
std::string progress_text(const ProgressCounts& counts, double seconds);

/// Shows progress on a stream: one line drawn over and over on a terminal, a plain line every ten seconds
/// elsewhere. `show` and `note` are to be called by one thread.
class ProgressLine {
 public:
  ProgressLine(const ProgressCounts& counts, std::FILE* stream, bool quiet);
  /// Wipes the line from the terminal.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Brings the line up to date; call a few times a second.
  void show();

  /// Prints a line that stays, above the progress line; also when quiet.
  void note(const std::string& text);

 private:
  void wipe();

  const ProgressCounts& counts_;
  std::FILE* stream_;
  bool quiet_;
  bool terminal_;
  std::size_t drawn_ = 0;  ///< characters on the terminal's line
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_ = start_;
};

}  // namespace holdfast
