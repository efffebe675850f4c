#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

#include "core/engine/run_observer.hpp"

namespace holdfast::internal {

/// The text of a progress line: done and in all, done per second, share of steps skipped (when there were steps),
/// remaining time.
/// @param noun what is counted: "worlds"
std::string progress_text(const RunProgress& progress, const char* noun, double seconds);

/// Shows progress on a stream: one line drawn over and over on a terminal, a plain line every ten seconds
/// elsewhere. `show` and `note` are to be called by one thread.
class ProgressLine {
 public:
  ProgressLine(const RunProgress& progress, const char* noun, std::FILE* stream, bool quiet);
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

  const RunProgress& progress_;
  const char* noun_;
  std::FILE* stream_;
  bool quiet_;
  bool terminal_;
  std::size_t drawn_ = 0;  ///< characters on the terminal's line
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_ = start_;
};

}  // namespace holdfast::internal
