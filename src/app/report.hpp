#pragma once

#include <span>

#include "app/exit_code.hpp"
#include "core/result.hpp"

namespace holdfast {

/// Prints errors on standard error, a line each, and returns the code.
ExitCode fail(ExitCode code, std::span<const Error> errors);
ExitCode fail(ExitCode code, const Error& error);

/// Prints warnings on standard error, a line each, marked as such.
void warn(std::span<const Error> warnings);

}  // namespace holdfast
