#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace holdfast::internal {

/// The finite decimal number that the whole text represents: `12`, `-0.5`, `+1e-3`. Nothing for any other text:
/// white space, hexadecimal, a decimal comma, `nan`, `inf`, a number too large or too small for a double.
/// Does not depend on the locale.
std::optional<double> parse_number(std::string_view text);

/// The integer that the whole text represents: `12`, `-3`, `+4`; nothing for any other text.
std::optional<long> parse_integer(std::string_view text);

/// The shortest text from which `parse_number` gives the same number.
std::string number_text(double number);

/// The number with at most that many significant digits, for messages: `0.0123`, `587`; a longer one is whole: `28200`.
std::string rounded_text(double number, int digits = 4);

}  // namespace holdfast::internal
