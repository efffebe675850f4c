#include "core/base/utf8.hpp"

#include <algorithm>

#include "core/base/result.hpp"

namespace holdfast::internal {

std::size_t utf8_length(std::string_view text) {
  const unsigned lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80U) return 1;
  if (lead < 0xC2U || lead > 0xF4U) return 0;
  const std::size_t length = lead < 0xE0U ? 2 : lead < 0xF0U ? 3 : 4;
  if (text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) return 0;
  // No surrogates, no overlong encodings, nothing above U+10FFFF.
  const unsigned second = static_cast<unsigned char>(text[1]);
  if ((lead == 0xE0U && second < 0xA0U) || (lead == 0xEDU && second > 0x9FU)) return 0;
  if ((lead == 0xF0U && second < 0x90U) || (lead == 0xF4U && second > 0x8FU)) return 0;
  return length;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& letter : result)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return result;
}

std::string kept_name(std::string_view text) {
  constexpr std::size_t kMost = 120;  // bytes
  constexpr std::string_view kWhite = " \t\r\v\f";
  const std::size_t begin = text.find_first_not_of(kWhite);
  if (begin == std::string_view::npos) return {};
  text = text.substr(begin, text.find_last_not_of(kWhite) - begin + 1);
  const bool is_plain = std::all_of(text.begin(), text.end(), [](char sign) { return sign >= ' ' && sign <= '~'; });
  if (is_plain && text.size() <= kMost) return std::string(text);
  std::string valid;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    valid += length == 0 ? "\xEF\xBF\xBD" : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  const std::string name = printable(std::move(valid));
  std::size_t end = 0;
  while (end < name.size()) {
    const std::size_t length = utf8_length(std::string_view(name).substr(end));
    if (end + length > kMost) break;
    end += length;
  }
  // White space where it was cut goes, as at its ends.
  return name.substr(0, std::string_view(name).substr(0, end).find_last_not_of(kWhite) + 1);
}

}  // namespace holdfast::internal
