#include "core/base/result.hpp"

#include <utility>

namespace holdfast::internal {

std::string printable(std::string text) {
  for (char& letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (byte < 0x20U || byte == 0x7FU) letter = '?';
  }
  return text;
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
  text += what;
  if (!value.empty()) text += ": " + value;
  if (!accepted.empty()) text += "; " + accepted;
  return text;
}

std::string summary_of(const std::vector<Error>& errors) {
  const std::size_t more = errors.size() - 1;
  return errors.front().message() + (more > 0 ? " (and " + std::to_string(more) + " more)" : "");
}

}  // namespace holdfast::internal
