#include "app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "analyses/analysis.hpp"
#include "api/version.hpp"
#include "app/command_line_pages.hpp"
#include "app/command_line_parts.hpp"
#include "app/commands.hpp"
#include "app/pages/accuracies_json.hpp"
#include "app/pages/containers_page.hpp"
#include "app/pages/norms_page.hpp"
#include "app/pages/results_page.hpp"
#include "app/pages/settings_page.hpp"
#include "app/report.hpp"
#include "core/base/closest_word.hpp"
#include "core/model/setting_table.hpp"
#include "parallel/schedulers/scheduler.hpp"

// CLI11, which takes seconds to compile, is kept to the files command_line*.

namespace holdfast::internal {

CLI::Validator as_in_config(const char* section, const char* name) {
  const SettingKey& key = *find_setting(section, name);
  return {[&key](const std::string& text) {
            Settings ignored;
            return key.set(ignored, "", text) ? "" : fmt::format("{}; accepted is {}", text, key.accepted);
          },
          ""};
}

namespace {

/// Adds what chooses an engine and its threads, of any options that have these members.
void add_engine_options(CLI::App& command, auto& options) {
  command.add_option("--engine", options.engine, "Engine that moves the boxes; see `holdfast engines`")
      ->type_name("NAME");
  command
      .add_option("--accuracy", options.accuracy,
                  "How far the native engine goes: screening, standard or reference; stands in for [Native] Accuracy")
      ->type_name("NAME");
  command.add_option("--threads", options.threads, "Threads; 0: one per core")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
}

/// Adds the norm, of any options that have the member.
void add_norm_option(CLI::App& command, auto& options) {
  command
      .add_option(
          "--norm", options.norm,
          "Take the accelerations of a norm, before those of files; `holdfast norms` lists norms; stands in for "
          "[Screening] Norm")
      ->type_name("NAME");
}

/// Adds how files of loads are read.
void add_load_options(CLI::App& command, LoadChoices& options) {
  command
      .add_option("--container", options.container,
                  "Container of all loads, also of those that say another; `holdfast containers` lists them; stands in "
                  "for [Container] Type")
      ->type_name("NAME");
  command
      .add_option("--unit", options.unit,
                  "Unit of lengths where a file does not say it: m, cm, mm, in, ...; stands in for [Loads] Unit")
      ->type_name("UNIT");
  command
      .add_option("--axes", options.axes,
                  "Axes of files that are length, width and height, with - where one counts from the far side: \"-z x "
                  "y\"; stands in for [Loads] Axes")
      ->type_name("AXES");
  command
      .add_option("--format", options.format,
                  "Known format of tables; `holdfast formats` lists them; stands in for [Loads] Format")
      ->type_name("NAME");
  command
      .add_option("--columns", options.columns,
                  "What columns of tables mean, where their words do not tell: \"PosX = y, Artikel = name\"; stands in "
                  "for [Loads] Columns")
      ->type_name("LIST");
}

/// Adds the options of every command that writes a results file.
void add_recording_options(CLI::App& command, RunOptions& options) {
  add_load_options(command, options.loads);
  add_norm_option(command, options);
  add_engine_options(command, options);
  command.add_option("--scheduler", options.scheduler, "How work is spread over threads: tbb, openmp or serial")
      ->type_name("NAME");
  command
      .add_option("--costs", options.costs_path,
                  "Write the processor seconds of reading, simulating, writing, ... as JSON")
      ->type_name("FILE");
  command
      .add_option(
          "--replicas", options.replicas,
          "Also simulate each world, and find each margin, so many times with friction that is not known exactly, "
          "32 for instance; stands in for [Screening] Replicas")
      ->check(as_in_config("Screening", "Replicas"))
      ->type_name("N");
  auto* go_on = command.add_flag("--resume", options.resume, "Go on with a run that was stopped or killed");
  command.add_flag("--overwrite", options.overwrite, "Replace the results of an earlier run")->excludes(go_on);
  command.add_flag("--json", options.json,
                   "Print one JSON object per world, with its verdict, and per layout with margins or indicators, as "
                   "it finishes; with --resume "
                   "the finished ones first");
  command.add_flag("--quiet", options.quiet, "No progress, no table; errors only");
}

void add_part_option(CLI::App& command, RunOptions& options) {
  command
      .add_option("--part", options.part,
                  "Simulate the K-th of N shards of the run alone, on one of several machines for instance; `holdfast "
                  "merge` puts them together")
      ->type_name("K/N");
}

/// The option of a key: "--wall-forces" of WallForces.
std::string option_of(std::string_view key) {
  std::string option = "-";
  for (const char letter : key) {
    if (letter >= 'A' && letter <= 'Z') option += '-';
    option += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return option;
}

/// Adds the options that `screen` and `run` share.
void add_run_options(CLI::App& command, RunOptions& options) {
  add_recording_options(command, options);
  for (const Analysis* analysis : all_analyses()) {
    if (analysis->key.empty()) continue;
    command.add_flag_function(
        option_of(analysis->key), [&options, analysis](std::int64_t) { options.analyses.push_back(analysis->key); },
        fmt::format("{}; stands in for [Screening] {}", analysis->option, analysis->key));
  }
  command
      .add_option("--walls", options.walls,
                  "Record the forces on the sides as --wall-forces does, and compare them with a norm: en12642-l, "
                  "en12642-xl, en283 or iso-container; stands in for "
                  "[Screening] Walls")
      ->check(as_in_config("Screening", "Walls"))
      ->type_name("NAME");
  command
      .add_option(
          "--stop-when", options.stop_when,
          "End a world when its verdict is decided: moved, as soon as a box is beyond a limit, fallen, as soon as one "
          "has fallen, or end, never; stands in for [Screening] StopWhen")
      ->check(as_in_config("Screening", "StopWhen"))
      ->type_name("NAME");
  command.add_flag(
      "--first-failure", options.first_failure,
      "Leave out the accelerations of a layout that has failed one; stands in for [Screening] FirstFailure");
  command.add_option("--text", options.text_folder, "Also write the three kinds of text files into this folder")
      ->type_name("DIR");
  command.add_flag("--no-series", options.no_series, "Keep end states and peaks only, no time series");
}

void add_screen_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("screen", "Simulate every layout under every acceleration");
  command->footer(
      "PATH is a regular file, a folder, or - for a list of paths on standard input.\n\n"
      "Example:\n"
      "  holdfast screen -c configs/demo.ini --layouts configs/layouts --norm road -o results.h5");
  auto options = std::make_shared<ScreenOptions>();
  command->add_option("-c,--config", options->config_path, "Configuration; see `holdfast --help-config`")
      ->type_name("FILE");
  command->add_option("--layouts", options->layouts, "Layouts")->required()->type_name("PATH");
  command->add_option("--accelerations", options->accelerations, "Accelerations; needed without a norm")
      ->type_name("PATH");
  command->add_option("-o,--output", options->results_path, "Results file")->capture_default_str()->type_name("FILE");
  add_part_option(*command, options->run);
  add_run_options(*command, options->run);
  command->callback([options, &chosen] {
    chosen.run = [options, &chosen] { return run_screen_command(*options, chosen.command_line, chosen.runner); };
  });
}

void add_run_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("run", "Do what a config.ini says: a batch folder or a single pair");
  command->footer(
      "Results and text files go to SavePath.\n\n"
      "Example:\n"
      "  holdfast run configs/free_container.ini");
  auto options = std::make_shared<ConfigRunOptions>();
  command->add_option("config", options->config_path, "Configuration")->required()->type_name("FILE");
  add_run_options(*command, options->run);
  command->callback([options, &chosen] {
    chosen.run = [options, &chosen] { return run_run_command(*options, chosen.command_line); };
  });
}

void add_margins_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("margins", "Find how many g each layout stands, and which box goes first");
  command->footer(
      "For the load pushed to the front, the rear, the left and the right: the largest constant acceleration, for as\n"
      "long as anything moves, under which every box stays in its place, within 5 mm, and that under which every box\n"
      "stays within the limits. With --norm, margins stand beside what the norm needs, and its accelerations are\n"
      "simulated as well.\n\n"
      "Example:\n"
      "  holdfast margins --layouts configs/layouts --norm road -o margins.h5");
  auto options = std::make_shared<MarginOptions>();
  command->add_option("-c,--config", options->config_path, "Configuration; see `holdfast --help-config`")
      ->type_name("FILE");
  command->add_option("--layouts", options->layouts, "Layouts")->required()->type_name("PATH");
  command->add_option("-o,--output", options->results_path, "Results file")->capture_default_str()->type_name("FILE");
  add_part_option(*command, options->run);
  add_recording_options(*command, options->run);
  command->callback([options, &chosen] {
    chosen.run = [options, &chosen] { return run_margins_command(*options, chosen.command_line, chosen.runner); };
  });
}

void add_serve_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("serve", "Answer layouts on standard input, line by line, with verdicts");
  command->footer(
      "A line of the input is one object of JSON, and so is its answer. Keys: \"boxes\", a list of boxes of seven\n"
      "numbers, which are two corners and a material, or of objects; optional are \"id\", which the answer repeats,\n"
      "\"unit\" of lengths, such as \"m\" or \"mm\", \"container\", \"accelerations\", a list of their names, and\n"
      "\"per_box\" and \"series\", true or false. A line that cannot be used is answered by an object with \"error\".\n"
      "The program ends with its input.\n\n"
      "Example:\n"
      "  echo '{\"id\": 1, \"boxes\": [[0, 0, 0, 0.8, 0.6, 1.0, 1]]}' | holdfast serve --norm road");
  auto options = std::make_shared<ServeOptions>();
  command->add_option("-c,--config", options->config_path, "Configuration; see `holdfast --help-config`")
      ->type_name("FILE");
  command->add_option("--accelerations", options->accelerations, "Accelerations; needed without a norm")
      ->type_name("PATH");
  add_norm_option(*command, *options);
  add_engine_options(*command, *options);
  command->add_flag("--ordered", options->ordered, "Answer in the order of the lines, not as layouts finish");
  command->callback([options, &chosen] { chosen.run = [options] { return run_serve_command(*options); }; });
}

void add_check_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command =
      program.add_subcommand("check", "Check inputs without simulating: layouts, accelerations, configs");
  command->footer(
      "Example:\n"
      "  holdfast check configs/layouts configs/accelerations configs/demo.ini");
  auto options = std::make_shared<CheckOptions>();
  command->add_option("paths", options->paths, "Files, folders, or - for a list on standard input")
      ->required()
      ->type_name("PATH");
  command->add_option("-c,--config", options->config_path, "Configuration that gives container and axes")
      ->type_name("FILE");
  add_load_options(*command, options->loads);
  command->add_flag("--bearing", options->bearing, "List the least and largest weight that rests on each box");
  command->callback([options, &chosen] { chosen.run = [options] { return run_check_command(*options); }; });
}

void add_bench_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("bench", "Measure how fast this machine screens");
  command->footer(
      "Every run is a `holdfast screen` of its own; speeds are reported only when all runs gave the same results.\n"
      "Speeds are medians over the repetitions; the spread is that of the fastest to the slowest.\n\n"
      "Example:\n"
      "  holdfast bench --layouts configs/layouts --accelerations configs/accelerations/road_brake_0g8.txt "
      "--engine native bullet --threads 1 2");
  auto options = std::make_shared<BenchOptions>();
  const int cores = thread_count(0);
  options->engines = {Settings{}.screening.engine};
  options->threads = cores > 1 ? std::vector{1, cores} : std::vector{1};
  command->add_option("-c,--config", options->config_path, "Configuration of all runs")->type_name("FILE");
  command->add_option("--layouts", options->layouts, "Layouts, all of them good")->required()->type_name("PATH");
  command->add_option("--accelerations", options->accelerations, "Accelerations")->required()->type_name("PATH");
  command->add_option("--engine", options->engines, "Engines to compare")->capture_default_str()->type_name("NAME");
  command->add_option("--threads", options->threads, "Numbers of threads to compare (default: 1, and one per core)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command
      ->add_option("--classes", options->classes, "Numbers of boxes at which layouts are cut into classes of their own")
      ->type_name("N");
  command->add_option("--repeats", options->repeats, "Runs of each kind")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  command
      ->add_option("--folder", options->folder,
                   "Where the results are written, and removed again (default: TMPDIR, or else /tmp)")
      ->type_name("DIR");
  command->add_option("--csv", options->csv_path, "Write one line per run there")->type_name("FILE");
  command->callback([options, &chosen] { chosen.run = [options] { return run_bench_command(*options); }; });
}

void add_validate_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("validate", "Measure engines against known answers: error and cost");
  command->footer(
      "A case passes when its error is within the tolerance of its class, the same for every engine. The exit code is "
      "1\n"
      "when an error is above what that engine and setting has reached before (its recorded bound).\n\n"
      "Example:\n"
      "  holdfast validate --quick\n"
      "  holdfast validate --suite slide,tip --engine bullet -o validation");
  auto options = std::make_shared<ValidateOptions>();
  command->add_option("--engine", options->engines, "Engines to measure (default: all)")->type_name("NAME");
  command
      ->add_option("--suite", options->suites, fmt::format("{} (default: all)", fmt::join(validation_suites(), ", ")))
      ->delimiter(',')
      ->type_name("NAME");
  command->add_option("--case", options->case_name, "One case by name")->type_name("NAME");
  command->add_option("--layouts", options->layouts, "Layouts of the load suite")
      ->capture_default_str()
      ->type_name("PATH");
  command->add_flag("--quick", options->quick, "Quick settings and cases, no loads: a minute");
  command->add_flag("--json", options->json, "Print the measurements as JSON, and nothing else");
  command->add_option("--threads", options->threads, "Threads; 0: one per core")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  command->add_option("-o,--output", options->folder, "Write tables, pictures and an HTML report into this folder")
      ->type_name("DIR");
  command->add_option("--bounds", options->bounds_path, "Recorded bounds (default: those of this version)")
      ->type_name("FILE");
  command->add_option("--record-bounds", options->record_path, "Record what is reached now as bounds into this file")
      ->type_name("FILE");
  command->callback([options, &chosen] { chosen.run = [options] { return run_validate_command(*options); }; });
}

void add_engines_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("engines", "List the engines, and why one cannot be used");
  command->footer("Example:\n  holdfast engines --devices");
  auto devices = std::make_shared<bool>(false);
  command->add_flag("--devices", *devices, "Also list the devices of engines that run on some; can take seconds");
  command->callback([devices, &chosen] { chosen.run = [devices] { return run_engines_command(*devices); }; });
}

void add_norms_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("norms", "List the norms that --norm takes, and friction by name");
  command->footer("Example:\n  holdfast norms");
  command->callback([&chosen] { chosen.run = run_norms_command; });
}

void add_containers_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("containers", "List the types of containers that --container takes");
  command->footer("Example:\n  holdfast containers");
  command->callback([&chosen] { chosen.run = run_containers_command; });
}

void add_formats_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("formats", "List the formats of tables that --format takes");
  command->footer("Example:\n  holdfast formats");
  command->callback([&chosen] { chosen.run = run_formats_command; });
}

void add_convert_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("convert", "Write loads of any kind of file as JSON or CSV");
  command->footer(
      "The name of the output says what is written: .json or .jsonl is JSON with one load per line, .csv is a table, "
      "and\n"
      ".txt is StableCargo's text, which has one load and no weights.\n\n"
      "Example:\n"
      "  holdfast convert configs/layouts -o loads.json");
  auto options = std::make_shared<ConvertOptions>();
  command->add_option("paths", options->layouts, "Loads")->required()->type_name("PATH");
  command->add_option("-o,--output", options->output_path, "Output")->required()->type_name("FILE");
  command->add_option("-c,--config", options->config_path, "Configuration")->type_name("FILE");
  command->add_flag("--overwrite", options->overwrite, "Replace the output if it is there");
  add_load_options(*command, options->loads);
  command->callback([options, &chosen] { chosen.run = [options] { return run_convert_command(*options); }; });
}

/// An option that prints a page and ends the program.
CLI::Option* add_page(CLI::App& program, const std::string& name, const std::string& description,
                      std::function<std::string()> page) {
  return program.add_flag_callback(
      name,
      [page = std::move(page)] {
        print_to(stdout, "{}", page());
        throw CLI::Success();
      },
      description);
}

std::string typed_line(int argc, char** argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) line += (i > 0 ? " " : "") + std::string(argv[i]);
  return line;
}

/// The first argument, which should be a command and is not. CLI11 itself would only say that a
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

/// The first argument of a command that the command does not know: an unknown option, or one argument too many. It is
/// reported first, since the other errors of CLI11 mostly follow from it.
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

/// Runs the command; a failure to get memory or a thread becomes a message.
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

int run_command_line(int argc, char** argv, const ScreeningRunner& runner) {
  CLI::App program{"Screens container loadings for dynamic stability: what slides, tips and falls."};
  program.footer(
      "Example:\n"
      "  holdfast screen --layouts configs/layouts --norm road -o results.h5\n\n"
      "Exit codes: 0 done, 1 some work failed, 2 bad usage or input, 130 and 143 stopped by a signal (Ctrl-C, kill),\n"
      "141 ended by the shell's pipe, whose reader took no more.");
  program.require_subcommand(1);
  program.set_version_flag("--version", fmt::format("holdfast {} ({})", kVersion, kGitCommit));
  add_page(program, "--help-config", "Print every key of config.ini and exit", settings_help);
  // For `make docs` alone, and not listed.
  add_page(program, "--config-page", "Print docs/reference/config.md and exit", settings_page)->group("");
  add_page(program, "--accuracies", "Print what each accuracy stands for, as JSON, and exit", accuracies_json)
      ->group("");
  add_page(program, "--norms-page", "Print docs/reference/norms.md and exit", norms_page)->group("");
  add_page(program, "--containers-page", "Print docs/reference/containers.md and exit", containers_page)->group("");
  add_page(program, "--results-page", "Print docs/reference/results_file.md and exit", results_page)->group("");
  add_page(program, "--man-page", "Print the manual page and exit", [&] { return man_page(program); })->group("");
  add_page(program, "--bash-completion", "Print the completion for bash and exit", [&] {
    return bash_completion(program);
  })->group("");

  ChosenCommand chosen;
  chosen.command_line = typed_line(argc, argv);
  chosen.runner = runner;
  add_screen_command(program, chosen);
  add_run_command(program, chosen);
  add_margins_command(program, chosen);
  add_serve_command(program, chosen);
  add_results_commands(program, chosen);
  add_check_command(program, chosen);
  add_bench_command(program, chosen);
  add_validate_command(program, chosen);
  add_engines_command(program, chosen);
  add_norms_command(program, chosen);
  add_containers_command(program, chosen);
  add_formats_command(program, chosen);
  add_convert_command(program, chosen);
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

}  // namespace holdfast::internal
