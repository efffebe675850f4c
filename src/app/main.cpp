#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/commands.hpp"
#include "app/version.hpp"
#include "core/closest_word.hpp"
#include "core/settings_page.hpp"
#include "io/results_page.hpp"

using namespace holdfast;

namespace {

/// An option that prints a page and ends the program.
void add_page(CLI::App& program, const std::string& name, const std::string& description, std::string (*page)()) {
  program.add_flag_callback(
      name,
      [page] {
        fmt::print("{}", page());
        throw CLI::Success();
      },
      description);
}

std::string words_of(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) line += (i > 0 ? " " : "") + std::string(argv[i]);
  return line;
}

/// The words that a program could have meant by one that it does not know: its commands, or the options of the
/// command that was chosen.
std::vector<std::string> known_words(const CLI::App& program, bool is_option) {
  std::vector<std::string> words;
  if (!is_option) {
    for (const CLI::App* command : program.get_subcommands({})) words.push_back(command->get_name());
    return words;
  }
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const CLI::App& command = chosen.empty() ? program : *chosen.front();
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  return words;
}

/// A word that belongs nowhere is told first: what else is wrong mostly follows from it. False when there is none.
bool tell_unknown_word(const CLI::App& program) {
  const std::vector<std::string> unknown = program.remaining(true);
  if (unknown.empty()) return false;
  const bool is_option = unknown.front().starts_with("-");
  // `--key=value` is known by its key.
  const std::string word = unknown.front().substr(0, is_option ? unknown.front().find('=') : std::string::npos);
  const std::vector<std::string> words = known_words(program, is_option);
  const auto meant = closest_word(word, std::vector<std::string_view>(words.begin(), words.end()));
  fmt::print(stderr, "{}: {}; {}\n",
             is_option                           ? "unknown option"
             : program.get_subcommands().empty() ? "unknown command"
                                                 : "a word too many",
             word, meant ? fmt::format("did you mean {}?", *meant) : "--help lists what there is");
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{"Screens container loadings for dynamic stability: what slides, tips and falls."};
  program.footer(
      "Example:\n"
      "  holdfast screen --layouts configs/layouts --accelerations configs/accelerations -o results.h5\n\n"
      "Exit codes: 0 done, 1 some work failed, 2 bad usage or input, 130 and 143 stopped by a signal.");
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
  add_engines_command(program, chosen);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0 && tell_unknown_word(program)) return static_cast<int>(ExitCode::bad_usage);
    return program.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::bad_usage);
  }
  return static_cast<int>(chosen.run());
}
