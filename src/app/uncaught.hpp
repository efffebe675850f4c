#pragma once

namespace holdfast::internal {

/// Makes an exception that nobody can catch end the program with a message and the exit code `some_failed`: memory that
/// runs out inside a library that cannot recover, a thread that cannot be started. What is in finished parts is kept.
void report_uncaught();

}  // namespace holdfast::internal
