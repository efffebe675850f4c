#include "io/loads/json_text.hpp"

#include <algorithm>

namespace holdfast::internal {

std::string pointer_part(std::string_view key) {
  std::string part = "/";
  for (const char letter : key) part += letter == '~' ? "~0" : letter == '/' ? "~1" : std::string(1, letter);
  return part;
}

std::string expected_in(std::string_view reason) {
  constexpr std::string_view kExpected = "; expected ";
  const std::size_t place = reason.find(kExpected);
  return place == std::string_view::npos ? "" : printable(std::string(reason.substr(place + kExpected.size())));
}

bool is_too_large(std::string_view reason) { return reason.find("out_of_range") != std::string_view::npos; }

Error json_fault(std::string_view text, std::size_t position, std::string_view reason, long line,
                 const std::string& path) {
  const std::string_view before = text.substr(0, std::min(position > 0 ? position - 1 : 0, text.size()));
  const std::size_t begin = before.rfind('\n') + 1;  // 0 where there is none
  return {.file = path,
          .line = line + static_cast<long>(std::count(before.begin(), before.end(), '\n')),
          .column = static_cast<long>(before.size() - begin) + 1,
          .what = is_too_large(reason) ? "a number that is too large" : "the text is not JSON",
          .accepted = expected_in(reason)};
}

}  // namespace holdfast::internal
