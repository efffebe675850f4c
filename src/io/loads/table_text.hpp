#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Longest cell of a table, bytes: longer ones are no table, but a quote that is never closed.
inline constexpr std::size_t kMostCellBytes = std::size_t{1} << 16U;

/// Most cells of a row.
inline constexpr std::size_t kMostCells = 1000;

/// A cell as it is in the file, without its quotes.
struct TableCell {
  std::string_view text;
  long line = 0;    ///< from 1
  long column = 0;  ///< of its first byte in that line, from 1
};

/// Reads the rows of a text one after the other: cells between separators, in quotes where they have separators, line
/// ends or quotes (twice) inside, as RFC 4180 describes it. Lines end with LF or CRLF; a byte order mark, blank lines
/// and comments are left out: lines that begin with `#`, but for rows with `#` or `#12` as first cell. White space
/// around cells is no part of them.
class TableText {
 public:
  /// @param separator `,`, `;`, a tab, or a blank, which stands for any number of blanks and tabs
  TableText(std::string_view text, char separator);

  /// Moves to the next row. False at the end, or at a mistake: see `error`.
  bool next();

  /// The row, valid until the next one.
  const std::vector<TableCell>& row() const { return row_; }

  /// What is wrong with the text where `next` ended early; empty otherwise.
  const std::string& error() const { return error_; }
  long line() const { return line_; }  ///< that has been read last, from 1

  void restart();

 private:
  bool read_row();
  bool is_comment() const;
  bool read_cell();
  bool read_quoted(TableCell& cell);
  void skip_blanks();
  bool fail(const char* what);
  bool at_line_end() const {
    if (at_ == text_.size() || text_[at_] == '\n') return true;
    return text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
  }
  long column() const { return static_cast<long>(at_ - line_begin_) + 1; }

  std::string_view text_;
  char separator_;
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  long line_ = 1;
  std::vector<TableCell> row_;
  std::deque<std::string> unquoted_;  ///< of the row, where quotes were written twice
  std::string error_;
};

/// What separates the cells of a text: of `;`, tab and `,` the one that its first lines have most often outside of
/// quotes; a blank where they have none of them.
char separator_of(std::string_view text);

/// What a file is instead of a text; nothing if it may be one.
std::optional<Error> why_no_text(const std::string& path, std::string_view bytes);

/// A text as UTF-8, and the encoding that it was in.
struct DecodedText {
  std::string text;
  const char* encoding;
};

/// The text of a file that is not UTF-8: UTF-16 is told by its zeros, anything else is taken as Windows-1252. Nothing
/// where it is UTF-8.
std::optional<DecodedText> decoded(std::string_view text);

}  // namespace holdfast::internal
