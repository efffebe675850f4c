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

/// Writes to a standard stream. A stream that cannot be written (closed, on a full disk) does not end a run: its
/// results are worth more than its messages.
void write_to(std::FILE* stream, std::string_view text);

/// The same, formatted.
template <class... Arguments>
void print_to(std::FILE* stream, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  write_to(stream, fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// The same, but once `stop` is set it does not wait for a reader that reads nothing: the text may end anywhere.
void write_unless(const std::atomic<bool>& stop, std::FILE* stream, std::string_view text);

/// Makes what the caller has closed or limited an error like any other. Standard streams that are closed get a
/// descriptor that cannot be written to: otherwise the first files opened get theirs, and messages are written into
/// them. A limit on the size of files makes writing fail, as a full disk does, and does not end the process.
void meet_the_callers_limits();

/// The exit code of a program that is about to end with `code`: `some_failed` instead of `done`, with a message, when
/// standard output could not take all that was printed.
ExitCode checked_output(ExitCode code);

/// Prints errors on standard error, one per line, and returns the code.
ExitCode fail(ExitCode code, std::span<const Error> errors);
ExitCode fail(ExitCode code, const Error& error);

/// Prints warnings on standard error, one per line, marked as such.
void warn(std::span<const Error> warnings);

}  // namespace holdfast::internal
