#include "core/model/wrapped_text.hpp"

#include <algorithm>

namespace holdfast::internal {

std::vector<std::string_view> words_of(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = text.find_first_not_of(separators);
    if (begin == std::string_view::npos) return words;
    text.remove_prefix(begin);
    const std::size_t end = std::min(text.find_first_of(separators), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

void append_wrapped(std::string& page, std::string_view text, std::size_t indent) {
  constexpr std::size_t kWidth = 100;
  const std::string margin(indent, ' ');
  std::size_t used = 0;
  for (const std::string_view word : words_of(text, " ")) {
    if (used > 0 && used + 1 + word.size() > kWidth) {
      page += '\n';
      used = 0;
    }
    page += used == 0 ? margin : " ";
    used += (used == 0 ? indent : 1) + word.size();
    page += word;
  }
  page += '\n';
}

}  // namespace holdfast::internal
