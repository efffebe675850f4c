#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace holdfast::internal {

/// The text with `?` in place of control characters, which a file name may contain and which would garble a message.
std::string printable(std::string text);

/// One error in a user's input, in the parts of which the message is made.
/// Lines and columns count from 1; 0 means that the error is not about one line, and is left out of the message.
struct Error {
  std::string file;      ///< path as the user wrote it; may be empty (a command-line value)
  long line = 0;         ///< line in `file`
  long column = 0;       ///< column of the value in that line
  std::string what;      ///< what is wrong, a clause without a full stop
  std::string value;     ///< the wrong value as it is in the input; may be empty
  std::string accepted;  ///< what would be accepted; may be empty
  long box = 0;          ///< of a layout, from 1; 0 when the error is not about one box
  long box_number = 0;   ///< which of that box's seven numbers (two corners, material), from 1; 0 when not about one

  /// The message of one line: `file:line:column: what: value; accepted`.
  std::string message() const;
};

/// The message of the first error, and how many more there are.
std::string summary_of(const std::vector<Error>& errors);

/// The error that reports that memory ran out, and what to do about it.
/// @param file  the file that the memory was needed for; may be empty
Error out_of_memory(const std::string& file, std::string what = "memory ran out");

/// A value, or the errors (at least one) in the input from which it should have come.
template <class T>
class Result {
 public:
  Result(T value) : content_(std::move(value)) {}
  Result(Error error) : content_(std::vector<Error>{std::move(error)}) {}
  Result(std::vector<Error> errors) : content_(std::move(errors)) {}

  /// True when there is a value.
  explicit operator bool() const { return content_.index() == 0; }

  /// The value; only when there is one.
  T& operator*() { return std::get<0>(content_); }
  const T& operator*() const { return std::get<0>(content_); }
  T* operator->() { return &std::get<0>(content_); }
  const T* operator->() const { return &std::get<0>(content_); }

  /// The errors, in the order of the input; only when there is no value.
  const std::vector<Error>& errors() const { return std::get<1>(content_); }
  const Error& error() const { return errors().front(); }

 private:
  std::variant<T, std::vector<Error>> content_;
};

}  // namespace holdfast::internal
