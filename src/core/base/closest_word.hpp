#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace holdfast::internal {

/// What a misspelt word may have meant: the candidate with the least edit distance (insertions, deletions,
/// replacements, swaps of neighbours; case is ignored), when that is small enough to be a slip.
std::optional<std::string_view> closest_word(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace holdfast::internal
