#pragma once

#include <string>

namespace holdfast::internal {

/// The page docs/reference/config.md as Markdown, generated from the table of keys.
std::string settings_page();

/// The same keys as plain text of at most 100 columns, for a terminal.
std::string settings_help();

}  // namespace holdfast::internal
