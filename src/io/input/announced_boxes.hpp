#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "io/input/text_lines.hpp"

namespace holdfast::internal {

/// The number of boxes that a layout's header announces, where that is another than the file has: what a copy that was
/// cut off looks like. Nothing where header and file agree, or the header announces none.
///
/// A header announces a count as `7 boxes`, or as the second of exactly two whole numbers, `30 7`, unless that is more
/// than a layout may have. Of two numbers the first may be the count as well: then the file agrees with it.
/// @param header words of the header
std::optional<std::size_t> contradicted_count(std::span<const Field> header, std::size_t found);

}  // namespace holdfast::internal
