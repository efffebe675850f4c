#pragma once

namespace holdfast::internal {

/// Reads the command line, runs its command and returns the exit code of the program.
int run_command_line(int argc, char** argv);

}  // namespace holdfast::internal
