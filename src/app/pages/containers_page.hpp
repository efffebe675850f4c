#pragma once

#include <string>

namespace holdfast::internal {

/// The page docs/reference/containers.md: all types with their numbers and sources.
std::string containers_page();

/// The same as a table for a terminal.
std::string containers_text();

}  // namespace holdfast::internal
