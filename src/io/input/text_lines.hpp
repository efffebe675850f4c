#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace holdfast::internal {

/// Walks the lines of a text without copying them. Lines end with LF or CRLF; a byte order mark of UTF-8 is skipped.
class LineReader {
 public:
  explicit LineReader(std::string_view text);

  /// Goes to the next line. False at the end of the text.
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

/// Most words of a line that are looked at; no file has a tenth of that in a line.
inline constexpr std::size_t kMostFields = 1000;

/// Puts the words of a line of data into `fields`: separated by white space, up to a `#` that begins a comment, the
/// first `kMostFields` of them.
void split_fields(std::string_view line, std::vector<Field>& fields);

/// The text without white space around it.
std::string_view trimmed(std::string_view text);

/// The text as UTF-8: what is none becomes U+FFFD. Names of files and texts of users may be in any encoding.
std::string valid_utf8(std::string_view text);

/// A piece of input for a message: at most 60 bytes of UTF-8. Control characters and what is no UTF-8 become `?`,
/// so that a wrong file (or a hostile one) cannot garble a terminal.
std::string shown(std::string_view text);

}  // namespace holdfast::internal
