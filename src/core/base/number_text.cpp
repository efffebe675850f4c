#include "core/base/number_text.hpp"

#include <charconv>
#include <cmath>

namespace holdfast::internal {

namespace {

template <class Number>
std::optional<Number> parse(std::string_view text) {
  // from_chars does not accept a leading plus sign.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  const std::optional<double> number = parse<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<long> parse_integer(std::string_view text) { return parse<long>(text); }

std::string number_text(double number) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr};
}

std::string rounded_text(double number, int digits) {
  constexpr double kTooLong = 1e9;
  const double size = std::abs(number);
  const bool is_whole = size >= std::pow(10.0, digits) && size < kTooLong;
  const auto format = is_whole ? std::chars_format::fixed : std::chars_format::general;
  char buffer[64];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number, format, is_whole ? 0 : digits).ptr};
}

}  // namespace holdfast::internal
