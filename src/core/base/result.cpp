#include "core/base/result.hpp"

#include <cstddef>
#include <string_view>
#include <utility>

namespace holdfast::internal {

std::string printable(std::string text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const unsigned next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (byte < 0x20U || byte == 0x7FU) {
      shown += '?';
    } else if (byte == 0xC2U && next >= 0x80U && next < 0xA0U) {  // U+0080 to U+009F in UTF-8, controls for a terminal
      shown += '?';
      ++i;
    } else {
      shown += text[i];
    }
  }
  // Unicode's controls of the direction of writing.
  for (const std::string_view turn :
       {"\u200E", "\u200F", "\u202A", "\u202B", "\u202C", "\u202D", "\u202E", "\u2066", "\u2067", "\u2068", "\u2069"})
    for (std::size_t at = shown.find(turn); at != std::string::npos; at = shown.find(turn, at))
      shown.replace(at, turn.size(), "?");
  return shown;
}

Error out_of_memory(const std::string& file, std::string what) {
  return {.file = file,
          .what = std::move(what),
          .accepted = "take less with fewer --threads, a longer ResultsIntervallInSeconds, or --no-series"};
}

std::string Error::message() const {
  std::string text = printable(file);
  if (line > 0) text += ':' + std::to_string(line);
  if (line > 0 && column > 0) text += ':' + std::to_string(column);
  if (!text.empty()) text += ": ";
  text += printable(what);
  if (!value.empty()) text += ": " + printable(value);
  if (!accepted.empty()) text += "; " + printable(accepted);
  return text;
}

std::string summary_of(const std::vector<Error>& errors) {
  const std::size_t more = errors.size() - 1;
  return errors.front().message() + (more > 0 ? " (and " + std::to_string(more) + " more)" : "");
}

}  // namespace holdfast::internal
