#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Writes the text into a file atomically: afterwards the file has either the whole text or its previous content.
std::optional<Error> write_text_file(const std::string& path, std::string_view text);

/// The reason why `write_text_file` cannot write to the path, found before the run whose results it will contain. An
/// existing file is replaced only if it is empty or of the same kind, so that an input is never overwritten.
/// @param is_same_kind returns whether the file at a path is of the kind that would be written
std::optional<Error> check_output_file(const std::string& path,
                                       const std::function<bool(const std::string&)>& is_same_kind);

}  // namespace holdfast::internal
