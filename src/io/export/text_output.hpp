#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Writes the text into a file, new or in place of an old one: afterwards either all of it is there, or what was
/// before.
std::optional<Error> write_text_file(const std::string& path, std::string_view text);

/// What keeps `write_text_file` from writing there, told before the work whose outcome it is to hold. A file that is
/// there already is replaced only when it is empty or of the same kind: nobody's input.
/// @param is_same_kind tells of a path whether the file there is what would be written
std::optional<Error> check_output_file(const std::string& path,
                                       const std::function<bool(const std::string&)>& is_same_kind);

}  // namespace holdfast::internal
