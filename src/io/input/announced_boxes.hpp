#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "io/input/text_lines.hpp"

namespace holdfast::internal {

/// The number of boxes that a layout's header announces, if it differs from the number in the file, as in a truncated
/// copy. Nothing if header and file agree, or if the header announces no number.
///
/// A header announces a count as `7 boxes`, or as the second of exactly two integers, `30 7`, unless that is more than
/// a layout may have. If the first of two integers equals the number in the file, header and file agree.
/// @param header words of the header
std::optional<std::size_t> contradicted_count(std::span<const Field> header, std::size_t found);

}  // namespace holdfast::internal
