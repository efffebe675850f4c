#pragma once

#include <cstddef>

namespace holdfast::internal {

/// Layouts that a table on the terminal shows, at most: the worst ones.
inline constexpr std::size_t kLayoutsShown = 20;

}  // namespace holdfast::internal
