#pragma once

namespace holdfast::internal {

/// Has an exception that nobody can catch end the program with a message and the exit code `some_failed`: memory that
/// ran out where a library cannot go back, a thread that cannot be had. What is in finished parts is kept.
void report_uncaught();

}  // namespace holdfast::internal
