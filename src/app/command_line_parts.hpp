#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "app/commands.hpp"

namespace holdfast::internal {

/// Runs the chosen command once the command line is read. Set by the command's callback, which owns its options.
struct ChosenCommand {
  std::function<ExitCode()> run;
  std::string command_line;  ///< as typed
  ScreeningRunner runner;    ///< of `screen` and `margins`
};

/// Checks the values of an option as those of the key of the configuration.
CLI::Validator as_in_config(const char* section, const char* name);

/// Adds the commands that read a results file.
void add_results_commands(CLI::App& program, ChosenCommand& chosen);

}  // namespace holdfast::internal
