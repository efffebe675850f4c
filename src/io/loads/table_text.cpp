#include "io/loads/table_text.hpp"

#include <algorithm>
#include <array>

#include "core/base/utf8.hpp"
#include "io/input/text_lines.hpp"

namespace holdfast::internal {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_blank(char letter) { return letter == ' ' || letter == '\t'; }

std::string_view without_mark(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

}  // namespace

TableText::TableText(std::string_view text, char separator) : text_(without_mark(text)), separator_(separator) {}

void TableText::restart() {
  at_ = 0;
  line_begin_ = 0;
  line_ = 1;
  error_.clear();
}

bool TableText::next() {
  while (at_ < text_.size()) {
    if (!read_row()) return false;
    const bool is_empty =
        std::all_of(row_.begin(), row_.end(), [](const TableCell& cell) { return cell.text.empty(); });
    if (!is_empty) return true;
  }
  return false;
}

bool TableText::read_row() {
  row_.clear();
  unquoted_.clear();
  skip_blanks();
  if (is_comment()) at_ = std::min(text_.find('\n', at_), text_.size());
  while (true) {
    if (at_line_end() && (row_.empty() || separator_ == ' ')) break;
    if (row_.size() == kMostCells) return fail("a row has more than 1000 cells");
    if (!read_cell()) return false;
    if (at_line_end()) break;
    if (separator_ != ' ') {
      ++at_;  // the separator
      if (at_line_end()) {
        row_.push_back({{}, line_, column()});
        break;
      }
    }
  }
  at_ = std::min(text_.find('\n', at_), text_.size());
  if (at_ < text_.size()) {
    ++at_;
    ++line_;
    line_begin_ = at_;
  }
  return true;
}

/// Whether a line that begins with # is none of the table. A row may begin with `#` or `#12` alone in its first cell.
bool TableText::is_comment() const {
  if (at_ == text_.size() || text_[at_] != '#') return false;
  constexpr std::ptrdiff_t kFewestSeparators = 5;
  const std::string_view line = text_.substr(at_ + 1, text_.find('\n', at_) - at_ - 1);
  const std::string_view first = trimmed(line.substr(0, line.find(separator_)));
  const bool is_number = first.find_first_not_of("0123456789") == std::string_view::npos;
  return separator_ == ' ' || !is_number || std::count(line.begin(), line.end(), separator_) < kFewestSeparators;
}

bool TableText::read_cell() {
  skip_blanks();
  TableCell cell{.line = line_, .column = column()};
  if (at_ < text_.size() && text_[at_] == '"') {
    if (!read_quoted(cell)) return false;
    skip_blanks();
    const bool ends = at_line_end() || (separator_ == ' ' ? is_blank(text_[at_ - 1]) : text_[at_] == separator_);
    if (!ends) return fail("a quote ends within a cell");
  } else {
    const std::size_t begin = at_;
    const auto ends = [&] {
      return at_line_end() || (separator_ == ' ' ? is_blank(text_[at_]) : text_[at_] == separator_);
    };
    while (!ends()) ++at_;
    cell.text = trimmed(text_.substr(begin, at_ - begin));
    if (separator_ == ' ') skip_blanks();
  }
  if (cell.text.size() > kMostCellBytes) return fail("a cell is too long");
  row_.push_back(cell);
  return true;
}

bool TableText::read_quoted(TableCell& cell) {
  const std::size_t begin = ++at_;
  bool has_quotes = false;
  while (true) {
    const std::size_t quote = text_.find('"', at_);
    if (quote == std::string_view::npos || quote - begin > kMostCellBytes) return fail("a quote is never closed");
    at_ = quote + 1;
    if (at_ == text_.size() || text_[at_] != '"') break;
    ++at_;
    has_quotes = true;
  }
  cell.text = text_.substr(begin, at_ - 1 - begin);
  // Line ends within the cell.
  const auto lines = std::count(cell.text.begin(), cell.text.end(), '\n');
  if (lines > 0) {
    line_ += static_cast<long>(lines);
    line_begin_ = begin + cell.text.rfind('\n') + 1;
  }
  if (has_quotes) {
    std::string& text = unquoted_.emplace_back();
    for (std::size_t i = 0; i < cell.text.size(); ++i) {
      text += cell.text[i];
      if (cell.text[i] == '"') ++i;  // the second of two
    }
    cell.text = text;
  }
  return true;
}

void TableText::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_]) && text_[at_] != separator_) ++at_;
  while (separator_ == ' ' && at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

bool TableText::fail(const char* what) {
  error_ = what;
  at_ = text_.size();
  return false;
}

char separator_of(std::string_view text) {
  constexpr std::size_t kLook = 4096;
  text = without_mark(text);
  text = text.substr(0, std::min(text.size(), kLook));
  constexpr std::array kSeparators = {';', '\t', '|', ','};
  std::array<std::size_t, kSeparators.size()> counts{};
  bool quoted = false;
  for (const char letter : text) {
    if (letter == '"') quoted = !quoted;
    for (std::size_t i = 0; i < kSeparators.size() && !quoted; ++i)
      if (letter == kSeparators[i]) ++counts[i];
  }
  // With decimal commas there may be as many commas as semicolons or tabs.
  for (std::size_t i = 0; i < kSeparators.size(); ++i)
    if (counts[i] > 0 && (i + 1 == kSeparators.size() || 2 * counts[i] >= counts.back())) return kSeparators[i];
  return ' ';
}

std::optional<Error> why_no_text(const std::string& path, std::string_view bytes) {
  const auto is = [&](const char* what) {
    return Error{.file = path, .what = what, .accepted = "text: save or export it as CSV (UTF-8)"};
  };
  if (bytes.starts_with("PK\x03\x04")) return is("is a spreadsheet file (.xlsx or .ods)");
  if (bytes.starts_with("\xD0\xCF\x11\xE0")) return is("is a spreadsheet file of an old kind (.xls)");
  constexpr std::size_t kLook = 512;
  const std::string_view begin = bytes.substr(0, kLook);
  if (begin.find("<html") != std::string_view::npos || begin.find("<table") != std::string_view::npos)
    return is("is HTML");
  return std::nullopt;
}

namespace {

void add_utf8(char32_t letter, std::string& text) {
  const auto add = [&](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (letter < 0x80U) return add(letter);
  if (letter < 0x800U) {
    add(0xC0U | letter >> 6U);
  } else {
    if (letter < 0x10000U) {
      add(0xE0U | letter >> 12U);
    } else {
      add(0xF0U | letter >> 18U);
      add(0x80U | (letter >> 12U & 0x3FU));
    }
    add(0x80U | (letter >> 6U & 0x3FU));
  }
  add(0x80U | (letter & 0x3FU));
}

/// The text of UTF-16. Halves of a pair without the other become U+FFFD.
/// @param low index of the low byte of each two
std::string from_utf16(std::string_view bytes, std::size_t low) {
  std::string text;
  const auto unit = [&](std::size_t i) {
    return static_cast<char32_t>(static_cast<unsigned char>(bytes[i + low])) |
           static_cast<char32_t>(static_cast<unsigned char>(bytes[i + 1 - low])) << 8U;
  };
  const auto is_first = [](char32_t half) { return half >= 0xD800U && half < 0xDC00U; };
  const auto is_second = [](char32_t half) { return half >= 0xDC00U && half < 0xE000U; };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    char32_t letter = unit(i);
    if (is_first(letter) && i + 3 < bytes.size() && is_second(unit(i + 2))) {
      letter = 0x10000U + ((letter - 0xD800U) << 10U) + (unit(i + 2) - 0xDC00U);
      i += 2;
    } else if (is_first(letter) || is_second(letter)) {
      letter = 0xFFFDU;
    }
    if (letter != 0xFEFFU) add_utf8(letter, text);
  }
  return text;
}

/// The text of Windows-1252, in which Western European Windows saves what is not UTF-8.
std::string from_windows_1252(std::string_view bytes) {
  constexpr std::array<char32_t, 32> kMiddle = {0x20AC, 0xFFFD, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                                0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0xFFFD, 0x017D, 0xFFFD,
                                                0xFFFD, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                                0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0xFFFD, 0x017E, 0x0178};
  std::string text;
  for (const char byte : bytes) {
    const auto letter = static_cast<unsigned char>(byte);
    const bool is_middle = letter >= 0x80U && letter < 0x80U + kMiddle.size();
    add_utf8(is_middle ? kMiddle.at(letter - 0x80U) : static_cast<char32_t>(letter), text);
  }
  return text;
}

bool is_utf8(std::string_view text) {
  const auto is_other = [](char byte) { return static_cast<unsigned char>(byte) >= 0x80U; };
  for (auto at = std::find_if(text.begin(), text.end(), is_other); at != text.end();
       at = std::find_if(text.begin(), text.end(), is_other)) {
    text.remove_prefix(static_cast<std::size_t>(at - text.begin()));
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

std::optional<DecodedText> decoded(std::string_view text) {
  const std::size_t zeros = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\0'));
  const bool is_big = text.starts_with("\xFE\xFF") || (text.size() > 1 && text[0] == '\0' && text[1] != '\0');
  if (text.starts_with("\xFF\xFE") || is_big || (zeros * 3 > text.size() && text.size() > 3))
    return DecodedText{from_utf16(text, is_big ? 1 : 0), "UTF-16"};
  if (is_utf8(text)) return std::nullopt;
  return DecodedText{from_windows_1252(text), "Windows-1252"};
}

}  // namespace holdfast::internal
