// core/base/number_text.hpp for emscripten's C++ library, whose from_chars and to_chars know whole numbers only.

#include "core/base/number_text.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace holdfast::internal {

namespace {

std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  text = without_plus(text);
  double number = 0.0;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<long> parse_integer(std::string_view text) {
  text = without_plus(text);
  long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string number_text(double number) {
  constexpr int kAlwaysEnough = 17;  // digits after which every double is itself again
  int digits = 1;
  while (digits < kAlwaysEnough && parse_number(rounded_text(number, digits)) != number) ++digits;
  // The shorter one of two forms, as to_chars writes it.
  char scientific[64];
  std::snprintf(scientific, sizeof scientific, "%.*e", digits - 1, number);
  const int exponent = static_cast<int>(*parse_integer(std::strchr(scientific, 'e') + 1));
  char fixed[512];
  std::snprintf(fixed, sizeof fixed, "%.*f", std::max(0, digits - 1 - exponent), number);
  return std::strlen(fixed) <= std::strlen(scientific) ? fixed : scientific;
}

std::string rounded_text(double number, int digits) {
  char buffer[64];
  const int size = std::snprintf(buffer, sizeof buffer, "%.*g", digits, number);
  return {buffer, static_cast<std::size_t>(size)};
}

}  // namespace holdfast::internal
