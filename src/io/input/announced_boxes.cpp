#include "io/input/announced_boxes.hpp"

#include "core/base/number_text.hpp"
#include "core/model/layout_check.hpp"

namespace holdfast::internal {

namespace {

/// The word as a possible number of boxes of a layout.
std::optional<std::size_t> count_of(const Field& word) {
  const std::optional<long> number = parse_integer(word.text);
  if (!number || *number < 0 || static_cast<std::size_t>(*number) > kMostBoxes) return std::nullopt;
  return static_cast<std::size_t>(*number);
}

}  // namespace

std::optional<std::size_t> contradicted_count(std::span<const Field> header, std::size_t found) {
  if (header.size() < 2 || !parse_integer(header[0].text)) return std::nullopt;
  const std::optional<std::size_t> first = count_of(header[0]);
  const bool in_words = header[1].text.starts_with("box");
  if (!in_words && (header.size() != 2 || !parse_integer(header[1].text))) return std::nullopt;
  if (first == found) return std::nullopt;
  const std::optional<std::size_t> announced = in_words ? first : count_of(header[1]);
  return announced == found ? std::nullopt : announced;
}

}  // namespace holdfast::internal
