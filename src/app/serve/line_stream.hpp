#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace holdfast::internal {

/// A line of the input, without its end.
struct InputLine {
  std::string_view text;  ///< valid until more is read
  long number = 0;        ///< from 1
  bool too_long = false;  ///< longer than may be; the text is empty
};

/// Cuts what comes from a descriptor into lines and keeps no more than the line at hand. Of a line that is too long
/// nothing is kept. It never waits but in `read_some`.
class LineStream {
 public:
  /// @param longest bytes that a line may have
  LineStream(int descriptor, std::size_t longest) : descriptor_(descriptor), longest_(longest) {}

  /// The next line that has been read; nothing when there is none, and more is to be read. The last line needs no end.
  std::optional<InputLine> next();

  /// Reads once, and waits until there is something. Only when `next` had nothing and the input has not ended.
  void read_some();

  /// True when nothing can be read any more; `next` may still have the last line.
  bool ended() const { return ended_; }

  /// Why the input ended before its end; empty when it did not.
  const std::string& failure() const { return failure_; }

 private:
  InputLine line(std::string_view text, bool too_long) { return {text, ++count_, too_long}; }

  int descriptor_;
  std::size_t longest_;
  std::string buffer_;
  std::size_t begin_ = 0;     ///< of the line at hand, in the buffer
  std::size_t searched_ = 0;  ///< up to there is no end of the line at hand
  long count_ = 0;            ///< lines that were given out
  bool skipping_ = false;     ///< the line at hand was given out as too long, and its end is to come
  bool ended_ = false;
  std::string failure_;
};

}  // namespace holdfast::internal
