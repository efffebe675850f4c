#include "io/input/text_lines.hpp"

#include <algorithm>

#include "core/base/utf8.hpp"

namespace holdfast::internal {

namespace {

constexpr std::string_view kWhite = " \t\r\v\f";

/// Bytes of the UTF-8 character at the beginning of the text; 0 if it is none, or a control character.
std::size_t character_length(std::string_view text) {
  const unsigned lead = static_cast<unsigned char>(text[0]);
  return lead < 0x20U || lead == 0x7FU ? 0 : utf8_length(text);
}

}  // namespace

LineReader::LineReader(std::string_view text) : rest_(text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

bool LineReader::next() {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line_ = rest_.substr(0, end);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++number_;
  return true;
}

void split_fields(std::string_view line, std::vector<Field>& fields) {
  fields.clear();
  line = line.substr(0, line.find('#'));
  std::size_t begin = line.find_first_not_of(kWhite);
  while (begin != std::string_view::npos && fields.size() < kMostFields) {
    const std::size_t end = std::min(line.find_first_of(kWhite, begin), line.size());
    fields.push_back({line.substr(begin, end - begin), static_cast<long>(begin) + 1});
    begin = line.find_first_not_of(kWhite, end);
  }
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kWhite);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kWhite) - begin + 1);
}

std::string valid_utf8(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    valid += length == 0 ? "\xEF\xBF\xBD" : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return valid;
}

std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::string clean;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t length = character_length(rest);
    if (clean.size() + std::max<std::size_t>(length, 1) > kMost) return clean + "...";
    clean += length == 0 ? "?" : rest.substr(0, length);
    rest.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return clean;
}

}  // namespace holdfast::internal
