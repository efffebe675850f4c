#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Errors of one file in the order in which they are found. The first ones are kept, the rest are only counted: every
/// line of a file can be wrong.
class ErrorList {
 public:
  static constexpr std::size_t kMost = 20;

  explicit ErrorList(std::string file) : file_(std::move(file)) {}

  bool empty() const { return errors_.empty(); }

  /// True when the next error will only be counted, so that its text is not needed.
  bool full() const { return errors_.size() == kMost; }

  /// Adds an error and sets its file.
  void add(Error error) {
    if (full()) return count_more();
    error.file = file_;
    errors_.push_back(std::move(error));
  }
  void count_more() { ++more_; }

  /// The errors; the last one says how many more there are.
  std::vector<Error> take() {
    if (more_ > 0) errors_.push_back({.file = file_, .what = "further errors", .value = std::to_string(more_)});
    more_ = 0;
    return std::exchange(errors_, {});
  }

 private:
  std::string file_;
  std::vector<Error> errors_;
  std::size_t more_ = 0;
};

}  // namespace holdfast::internal
