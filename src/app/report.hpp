#pragma once

#include <fmt/format.h>

#include <atomic>
#include <cstdio>
#include <span>
#include <string_view>
#include <utility>

#include "app/exit_code.hpp"
#include "core/base/result.hpp"

namespace holdfast::internal {

/// Writes to a standard stream. One that takes nothing (closed, on a full disk) does not end a run, whose results are
/// worth more than what is said of them.
void write_to(std::FILE* stream, std::string_view text);

/// The same, formatted.
template <class... Arguments>
void print_to(std::FILE* stream, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  write_to(stream, fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// The same without waiting for a reader that takes nothing once `stop` is set: the text may end anywhere.
void write_unless(const std::atomic<bool>& stop, std::FILE* stream, std::string_view text);

/// Has the standard streams' numbers taken where the caller has closed them: the first files opened would get them, and
/// be written into.
void hold_standard_streams();

/// The exit code of a program that is about to end with `code`: `some_failed` instead of `done`, and told, when
/// standard output did not take all that was printed.
ExitCode checked_output(ExitCode code);

/// Prints errors on standard error, a line each, and returns the code.
ExitCode fail(ExitCode code, std::span<const Error> errors);
ExitCode fail(ExitCode code, const Error& error);

/// Prints warnings on standard error, a line each, marked as such.
void warn(std::span<const Error> warnings);

}  // namespace holdfast::internal
