#include "ini.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace {

constexpr int kLongestLine = 200;  ///< as inih's, bytes
constexpr std::string_view kWhite = " \t\r\n\f\v";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kWhite);
  return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(kWhite) + 1 - begin);
}

/// The text before a `;` that stands behind white space.
std::string_view without_comment(std::string_view text) {
  for (std::size_t i = 1; i < text.size(); ++i)
    if (text[i] == ';' && kWhite.find(text[i - 1]) != std::string_view::npos) return text.substr(0, i);
  return text;
}

}  // namespace

int ini_parse_stream(ini_reader reader, void* stream, ini_handler handler, void* user) {
  char line[kLongestLine];
  while (reader(line, kLongestLine, stream) != nullptr) {
    const std::string_view text = without_comment(line);
    const std::size_t between = text.find_first_of("=:");
    if (between == std::string_view::npos) continue;
    const std::string name(trimmed(text.substr(0, between)));
    const std::string value(trimmed(text.substr(between + 1)));
    handler(user, "", name.c_str(), value.c_str());
  }
  return 0;
}
