#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace holdfast::internal {

/// Iterates over the lines of a text without copying them. Lines end with LF or CRLF; a UTF-8 byte order mark is
/// skipped.
class LineReader {
 public:
  explicit LineReader(std::string_view text);

  /// Moves to the next line. False at the end of the text.
  bool next();

  std::string_view line() const { return line_; }  ///< without its end
  long number() const { return number_; }          ///< from 1

 private:
  std::string_view rest_;
  std::string_view line_;
  long number_ = 0;
};

/// A word of a line.
struct Field {
  std::string_view text;
  long column = 0;  ///< of its first byte, from 1
};

/// Largest number of words of a line that are read; ten times what any file has in a line.
inline constexpr std::size_t kMostFields = 1000;

/// Sets `fields` to the words of a line of data: separated by white space, up to a `#` that begins a comment; at most
/// the first `kMostFields`.
void split_fields(std::string_view line, std::vector<Field>& fields);

/// The text without white space around it.
std::string_view trimmed(std::string_view text);

/// The text as UTF-8: invalid bytes become U+FFFD. File names and texts from users may have any encoding.
std::string valid_utf8(std::string_view text);

/// A piece of input for a message: at most 60 bytes of UTF-8. Control characters and invalid bytes become `?`, so that
/// no file can garble a terminal.
std::string shown(std::string_view text);

}  // namespace holdfast::internal
