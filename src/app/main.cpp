#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <new>
#include <optional>
#include <system_error>

#include "api/version.hpp"
#include "app/commands.hpp"
#include "app/report.hpp"
#include "app/uncaught.hpp"
#include "core/base/closest_word.hpp"
#include "core/model/settings_page.hpp"
#include "io/results/results_page.hpp"

using namespace holdfast::internal;

namespace {

/// An option that prints a page and ends the program.
void add_page(CLI::App& program, const std::string& name, const std::string& description, std::string (*page)()) {
  program.add_flag_callback(
      name,
      [page] {
        print_to(stdout, "{}", page());
        throw CLI::Success();
      },
      description);
}

std::string words_of(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) line += (i > 0 ? " " : "") + std::string(argv[i]);
  return line;
}

/// The first word of a command line that should be a command and is none. CLI11 itself would only say that a
/// command is required.
std::optional<Error> unknown_command(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return std::nullopt;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return std::nullopt;
  const auto meant = closest_word(argv[1], std::vector<std::string_view>(names.begin(), names.end()));
  return Error{.what = "unknown command",
               .value = argv[1],
               .accepted = meant ? fmt::format("did you mean '{}'?", *meant)
                                 : fmt::format("accepted are {}", fmt::join(names, ", "))};
}

/// The first word behind a command that belongs nowhere: an unknown option, or one word too many. It is told before
/// all else, since what else CLI11 finds wrong mostly follows from it.
std::optional<Error> unknown_word(const CLI::App& program) {
  const std::vector<std::string> left = program.remaining(true);
  if (left.empty()) return std::nullopt;
  if (!left.front().starts_with("-")) return Error{.what = "a word too many", .value = left.front()};
  const std::string option = left.front().substr(0, left.front().find('='));
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const CLI::App& command = chosen.empty() ? program : *chosen.front();
  std::vector<std::string> names;
  for (const CLI::Option* known : command.get_options())
    for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
  const auto meant = closest_word(option, std::vector<std::string_view>(names.begin(), names.end()));
  return Error{.what = "unknown option",
               .value = option,
               .accepted = meant ? fmt::format("did you mean '{}'?", *meant) : "--help lists all"};
}

/// Runs the command; what it cannot have, memory or a thread, becomes a message.
ExitCode run_within_memory(const ChosenCommand& chosen) {
  try {
    return chosen.run();
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::some_failed, out_of_memory(""));
  } catch (const std::system_error& error) {
    return fail(ExitCode::some_failed, {.what = "the system refused", .value = error.what()});
  }
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  report_uncaught();
  CLI::App program{"Screens container loadings for dynamic stability: what slides, tips and falls."};
  program.footer(
      "Example:\n"
      "  holdfast screen --layouts configs/layouts --accelerations configs/accelerations -o results.h5\n\n"
      "Exit codes: 0 done, 1 some work failed, 2 bad usage or input, 130 and 143 stopped by a signal (Ctrl-C, kill),\n"
      "141 ended by the shell's pipe, whose reader took no more.");
  program.require_subcommand(1);
  program.set_version_flag("--version", fmt::format("holdfast {} ({})", kVersion, kGitCommit));
  add_page(program, "--help-config", "Print every key of config.ini and exit", settings_help);
  add_page(program, "--config-page", "Print docs/config.md and exit", settings_page);
  add_page(program, "--results-page", "Print docs/results_file.md and exit", results_page);

  ChosenCommand chosen;
  chosen.command_line = words_of(argc, argv);
  add_screen_command(program, chosen);
  add_run_command(program, chosen);
  add_summary_command(program, chosen);
  add_check_command(program, chosen);
  add_bench_command(program, chosen);
  add_validate_command(program, chosen);
  add_engines_command(program, chosen);
  if (const auto error = unknown_command(program, argc, argv))
    return static_cast<int>(fail(ExitCode::bad_usage, *error));
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const auto unknown = error.get_exit_code() == 0 ? std::nullopt : unknown_word(program);
    if (unknown) return static_cast<int>(fail(ExitCode::bad_usage, *unknown));
    return static_cast<int>(checked_output(program.exit(error) == 0 ? ExitCode::done : ExitCode::bad_usage));
  }
  return static_cast<int>(checked_output(run_within_memory(chosen)));
}
