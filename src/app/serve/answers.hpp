#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/serve/layout_request.hpp"
#include "core/base/result.hpp"
#include "holdfast/holdfast.hpp"

namespace holdfast::internal {

/// The line that an answer is about.
struct AnsweredLine {
  std::string id = "null";                  ///< text of JSON
  std::uint64_t layout = 0;                 ///< index among the lines that are not empty
  long line = 0;                            ///< number among all lines, from 1
  std::vector<std::string> box_names = {};  ///< of its boxes; empty where none has one
};

/// What became of a layout, as one line of JSON with its end.
/// @param accelerations names of those of `worlds`
std::string verdicts_text(const AnsweredLine& line, std::span<const holdfast::WorldOutcome> worlds,
                          std::span<const std::string> accelerations, const RequestOptions& options);

/// What is wrong with a line, in the same form.
/// @param more how many further mistakes there are
std::string error_text(const AnsweredLine& line, const Error& error, std::size_t more = 0);

/// Writes answers to standard output as they come, or in the order in which they were announced.
class AnswerQueue {
 public:
  /// @param drop when it is set, nobody is waited for
  AnswerQueue(bool ordered, const std::atomic<bool>& drop) : ordered_(ordered), drop_(drop) {}

  /// Announces an answer, and returns the ticket to give it with.
  std::uint64_t announce() { return announced_++; }

  /// Writes the answer, or keeps it until those before it are written.
  void give(std::uint64_t ticket, std::string text);

  /// Answers that were announced and are not written.
  std::size_t outstanding() const { return static_cast<std::size_t>(announced_ - written_); }
  std::uint64_t written() const { return written_; }

 private:
  void write(const std::string& text);

  bool ordered_;
  const std::atomic<bool>& drop_;
  std::uint64_t announced_ = 0;
  std::uint64_t written_ = 0;
  std::map<std::uint64_t, std::string> kept_;  // that wait for answers before them
};

}  // namespace holdfast::internal
