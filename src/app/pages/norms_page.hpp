#pragma once

#include <string>

namespace holdfast::internal {

/// docs/reference/norms.md, generated from the tables of norms and of friction.
std::string norms_page();

/// The same tables for a terminal, as `holdfast norms` prints them.
std::string norms_help();

}  // namespace holdfast::internal
