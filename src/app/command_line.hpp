#pragma once

#include "app/screening.hpp"

namespace holdfast::internal {

/// Reads the command line, runs its command and returns the exit code of the program.
/// @param runner runs the jobs of `screen` and `margins`
int run_command_line(int argc, char** argv, const ScreeningRunner& runner = run_screening);

}  // namespace holdfast::internal
