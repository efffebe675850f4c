#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace holdfast::internal {

/// The words of a text; any of the characters in `separators` separates them.
std::vector<std::string_view> words_of(std::string_view text, std::string_view separators);

/// Appends a text to a page for a terminal, indented by so many spaces, with line breaks between words.
void append_wrapped(std::string& page, std::string_view text, std::size_t indent);

}  // namespace holdfast::internal
