#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "app/exit_code.hpp"

namespace holdfast::internal {

/// What the chosen command does, once the command line is read. Set by the command's callback.
struct ChosenCommand {
  std::function<ExitCode()> run;
  std::string command_line;  ///< as typed
};

/// Each adds one command to the program's command line; a file a command. The options live as long as the
/// program's callback.
void add_screen_command(CLI::App& program, ChosenCommand& chosen);
void add_run_command(CLI::App& program, ChosenCommand& chosen);
void add_summary_command(CLI::App& program, ChosenCommand& chosen);
void add_check_command(CLI::App& program, ChosenCommand& chosen);
void add_bench_command(CLI::App& program, ChosenCommand& chosen);
void add_validate_command(CLI::App& program, ChosenCommand& chosen);
void add_engines_command(CLI::App& program, ChosenCommand& chosen);

}  // namespace holdfast::internal
