#include "app/command_line_pages.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "api/version.hpp"

namespace holdfast::internal {

namespace {

/// Text as roff prints it: hyphens as typed, and no line that is taken for a request.
std::string roff(std::string_view text) {
  std::string escaped;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
    line_begins = c == '\n';
  }
  return escaped;
}

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

/// The options that a user is shown; those without a group are for developers.
std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::string option_entry(const CLI::Option& option) {
  const bool positional = option.get_positional();
  const std::string names = positional ? option.get_name(true) : option.get_name(false, true);
  const std::string type = option.get_type_size() == 0 ? "" : " " + option.get_type_name();
  const std::string standard =
      option.get_default_str().empty() ? "" : fmt::format(" (default: {})", option.get_default_str());
  return fmt::format(".TP\n.B {}{}\n{}.\n", roff(names), roff(type), roff(option.get_description() + standard));
}

/// Paragraphs of a footer, each line on its own.
std::string lines_as_typed(const std::string& text) { return fmt::format(".nf\n{}\n.fi\n", roff(text)); }

std::string words(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, " ")); }

std::string option_words(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(command))
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return words(names);
}

}  // namespace

std::string man_page(const CLI::App& program) {
  std::string page = fmt::format(
      ".TH HOLDFAST 1 \"\" \"holdfast {}\" \"User Commands\"\n"
      ".SH NAME\nholdfast \\- screen container loadings for dynamic stability\n"
      ".SH SYNOPSIS\n.B holdfast\n.I command\n[\n.I options\n]\n"
      ".SH DESCRIPTION\n{}\n.B holdfast \\-\\-help\\-config\nlists every key of a configuration.\n"
      ".SH OPTIONS\n",
      kVersion, roff(program.get_description()));
  for (const CLI::Option* option : options_of(program)) page += option_entry(*option);
  page += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(program)) {
    page += fmt::format(".SS holdfast {}\n{}.\n", roff(command->get_name()), roff(command->get_description()));
    for (const CLI::Option* option : options_of(*command)) page += option_entry(*option);
    if (!command->get_footer().empty()) page += ".PP\n" + lines_as_typed(command->get_footer());
  }
  return page + ".SH EXAMPLES AND EXIT STATUS\n" + lines_as_typed(program.get_footer());
}

std::string bash_completion(const CLI::App& program) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* command : commands_of(program)) {
    names.push_back(command->get_name());
    cases += fmt::format("    {}) options='{}' ;;\n", command->get_name(), option_words(*command));
  }
  return fmt::format(
      "# Completion of holdfast for bash, written by `holdfast --bash-completion`.\n"
      "_holdfast() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} options\n"
      "  case ${{COMP_WORDS[1]}} in\n{}    *) options='{}' ;;\n  esac\n"
      "  if [[ $word == -* ]]; then\n"
      "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
      "  elif ((COMP_CWORD == 1)); then\n"
      "    mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$word\")\n"
      "  else\n"
      "    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
      "  fi\n"
      "}}\n"
      "complete -o filenames -F _holdfast holdfast\n",
      cases, option_words(program), words(names));
}

}  // namespace holdfast::internal
