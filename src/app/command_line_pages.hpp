#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace holdfast::internal {

/// The manual page of the program in roff, from its table of commands and options.
std::string man_page(const CLI::App& program);

/// A script for bash that completes commands, options and names of files.
std::string bash_completion(const CLI::App& program);

}  // namespace holdfast::internal
