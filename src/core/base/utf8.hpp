#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace holdfast::internal {

/// Bytes of the UTF-8 character at the beginning of the text, which is not empty; 0 if it is not valid UTF-8.
std::size_t utf8_length(std::string_view text);

/// The text with the letters of ASCII in lower case.
std::string lower_case(std::string_view text);

/// The name of a box or a load as it is kept: without white space around it, as UTF-8 without control characters, at
/// most 120 bytes of it, cut at a character. Invalid bytes become U+FFFD.
std::string kept_name(std::string_view text);

}  // namespace holdfast::internal
