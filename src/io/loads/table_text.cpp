#include "io/loads/table_text.hpp"

#include <algorithm>
#include <array>

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
  if (at_ < text_.size() && text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size());
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
  constexpr std::array kSeparators = {';', '\t', ','};
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

std::string encoding_mistake(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return "UTF-16";
  const std::size_t zeros = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\0'));
  if (zeros * 3 > text.size() && text.size() > 3) return "UTF-16";
  if (text.starts_with("PK\x03\x04")) return "a spreadsheet file (.xlsx or .ods)";
  return {};
}

}  // namespace holdfast::internal
