#pragma once

namespace holdfast::internal {

/// Exit code of the program. A shell shows 141 when the program writes into a pipe whose reader has ended: SIGPIPE
/// keeps its usual effect.
enum class ExitCode : int {
  done = 0,
  some_failed = 1,    ///< some worlds failed, or a file could not be written; the rest is complete and readable
  bad_usage = 2,      ///< bad command line or input
  interrupted = 130,  ///< SIGINT; what finished is kept
  terminated = 143,   ///< SIGTERM; what finished is kept
};

}  // namespace holdfast::internal
