#include "app/command_line_pages.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "api/version.hpp"
#include "app/commands.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/model/container_catalogue.hpp"
#include "core/model/length_unit.hpp"
#include "core/model/norms.hpp"
#include "core/model/setting_table.hpp"
#include "core/model/wrapped_text.hpp"
#include "io/loads/known_formats.hpp"
#include "parallel/schedulers/scheduler.hpp"

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

/// The words of a key that takes one of some.
std::vector<std::string> words_of_key(std::string_view section, std::string_view name) {
  const SettingKey& key = *find_setting(section, name);
  std::vector<std::string> accepted;
  for (const std::string_view word : words_of(key.accepted, " ,")) {
    Settings ignored;
    if (key.set(ignored, "", word)) accepted.emplace_back(word);
  }
  return accepted;
}

/// The values of an option that takes one of some, from the tables of the program; none of any other.
std::vector<std::string> values_of(const CLI::Option& option) {
  const std::string name = option.get_lnames().empty() ? "" : option.get_lnames().front();
  std::vector<std::string> values;
  if (name == "engine") {
    for (const EngineEntry& entry : engine_registry()) values.emplace_back(entry.name);
  } else if (name == "norm") {
    for (const Norm& norm : norms()) values.push_back(std::string(norm.name) + (norm.takes_size ? ":" : ""));
  } else if (name == "container") {
    for (const ContainerType& type : container_catalogue()) values.emplace_back(type.name);
  } else if (name == "format") {
    for (const KnownFormat& format : kKnownFormats) values.emplace_back(format.name);
  } else if (name == "unit") {
    for (const Unit& unit : kLengthUnits) values.emplace_back(unit.word);
  } else if (name == "accuracy") {
    values = words_of_key("Native", "Accuracy");
  } else if (name == "scheduler") {
    values = scheduler_names();
  } else if (name == "walls") {
    values = words_of_key("Screening", "Walls");
  } else if (name == "stop-when") {
    values = words_of_key("Screening", "StopWhen");
  } else if (name == "suite") {
    values = validation_suites();
  } else if (name == "case") {
    values = validation_cases();
  }
  return values;
}

/// What makes bash's compgen list the values of an option; empty where there is nothing to list, as for a number.
std::string offer_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type == "FILE" || type == "PATH") return "(-f)";
  if (type == "DIR") return "(-d)";
  const std::vector<std::string> values = values_of(option);
  return values.empty() ? "()" : fmt::format("(-W '{}')", words(values));
}

/// The branch of a command in the completion: its options, and what bash offers as the value of each.
std::string completion_of(const CLI::App& command) {
  std::string branch = fmt::format("      options='{}'\n      case $option in\n", option_words(command));
  // Where a command takes nothing else, an option is what comes next.
  std::string positional = "(-W \"$options\")";
  for (const CLI::Option* option : options_of(command)) {
    if (option->get_positional()) positional = offer_of(*option);
    if (option->get_positional() || option->get_items_expected_max() == 0) continue;  // a flag has no value
    std::vector<std::string> names;
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    branch += fmt::format("        {}) takes={} offer={} ;;\n", fmt::join(names, " | "),
                          option->get_items_expected_max() > 1 ? "many" : "one", offer_of(*option));
  }
  return branch + fmt::format("      esac\n      positional={}\n", positional);
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
    cases += fmt::format("    {})\n{}      ;;\n", command->get_name(), completion_of(*command));
  }
  return fmt::format(
      R"(# Completion of holdfast for bash, written by `holdfast --bash-completion`.
_holdfast() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} options option= takes= offer=() positional=() before= i
  # Bash makes a word of its own of an equals sign.
  [[ $word != = ]] || word=
  # The option that the word may be a value of: the last one before it.
  for ((i = COMP_CWORD - 1; i > 1; --i)); do
    if [[ ${{COMP_WORDS[i]}} == -* ]]; then
      option=${{COMP_WORDS[i]}}
      break
    fi
  done
  case ${{COMP_WORDS[1]}} in
{}    *) options='{}' ;;
  esac
  if [[ -z $takes || $takes == one && $i != $((COMP_CWORD - 1)) && ${{COMP_WORDS[i + 1]}} != = ]]; then
    offer=("${{positional[@]}}")
  fi
  if [[ $word == -* ]]; then
    offer=(-W "$options")
  elif ((COMP_CWORD == 1)); then
    offer=(-W '{}')
  fi
  COMPREPLY=()
  ((${{#offer[@]}} > 0)) || return 0
  # Of several values with commas between them, the last one is to be completed.
  [[ ${{offer[0]}} != -W || $word != *,* ]] || before=${{word%,*}},
  mapfile -t COMPREPLY < <(compgen -P "$before" "${{offer[@]}}" -- "${{word#"$before"}}")
  # The size of a norm follows its colon.
  [[ ${{COMPREPLY[*]}} != *: ]] || compopt -o nospace 2> /dev/null
}}
complete -o filenames -F _holdfast holdfast
)",
      cases, option_words(program), words(names));
}

}  // namespace holdfast::internal
