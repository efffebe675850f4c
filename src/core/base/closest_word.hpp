#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace holdfast::internal {

/// The word that a misspelt word probably means: the candidate with the smallest edit distance (insertions, deletions,
/// replacements, swaps of neighbours; case is ignored), if that is small enough for a typing error.
std::optional<std::string_view> closest_word(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace holdfast::internal
