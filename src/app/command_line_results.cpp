#include <CLI/CLI.hpp>
#include <memory>

#include "app/command_line_parts.hpp"
#include "app/commands.hpp"

namespace holdfast::internal {

namespace {

void add_memory_option(CLI::App* command, int& memory, const char* help) {
  command->add_option("--memory", memory, help)->capture_default_str()->check(CLI::Range(64, 1 << 20))->type_name("MB");
}

constexpr const char* kMemoryHelp = "Memory that reading the file may take, MB";

void add_merge_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("merge", "Put the shards of a run together, that were made with --part");
  command->footer(
      "The results file has the same bytes as that of a run on one machine, times aside. Shards stay where they "
      "are.\n\n"
      "Example:\n"
      "  holdfast screen --layouts layouts --norm road -o results.h5 --part 1/2\n"
      "  holdfast screen --layouts layouts --norm road -o results.h5 --part 2/2\n"
      "  holdfast merge results.h5");
  auto options = std::make_shared<MergeOptions>();
  command->add_option("results", options->results_path, "Results file to write")->required()->type_name("FILE");
  command
      ->add_option("shards", options->shards,
                   "Shards, and folders of shards; without any, those in the folder FILE.shards")
      ->type_name("PATH");
  command->add_option("--threads", options->threads, "Threads; 0: one per core")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  add_memory_option(command, options->memory, "Memory that each thread may take, MB");
  command->add_flag("--overwrite", options->overwrite, "Replace the results of an earlier run");
  command->add_flag("--quiet", options->quiet, "No progress; errors only");
  command->callback([options, &chosen] { chosen.run = [options] { return run_merge_command(*options); }; });
}

void add_summary_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("summary", "Judge a results file again, with other thresholds if given");
  command->footer(
      "The results file itself is never changed.\n\n"
      "Example:\n"
      "  holdfast summary results.h5 --move-threshold 0.05 --csv tables/");
  auto options = std::make_shared<SummaryOptions>();
  command->add_option("results", options->results_path, "Results file")->required()->type_name("FILE");
  command->add_option("--drop-threshold", options->drop, "Fallen when lower by more, m")
      ->check(as_in_config("Simulation Settings", "DropThreshold"));
  command->add_option("--move-threshold", options->move, "Moved when displaced by more, m")
      ->check(as_in_config("Screening", "MoveThreshold"));
  command->add_option("--tilt-threshold", options->tilt, "Tilted when rotated by more, degrees")
      ->check(as_in_config("Screening", "TiltThreshold"));
  command
      ->add_option("--csv", options->csv_folder,
                   "Write worlds.csv and boxes.csv, and files of analyses such as margins.csv, into this folder")
      ->type_name("DIR");
  command->add_option("-o,--output", options->output_path, "Write the tables into this new HDF5 file")
      ->type_name("FILE");
  add_memory_option(command, options->memory, kMemoryHelp);
  command->callback([options, &chosen] { chosen.run = [options] { return run_summary_command(*options); }; });
}

void add_report_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command =
      program.add_subcommand("report", "Write a page to print for each layout, the worst first, as HTML or PDF");
  command->footer(
      "A page shows five views of the load, what it stands and fails under, and which box goes first; margins and\n"
      "forces on the walls, where the run was asked for them. PDF takes WeasyPrint, Debian's package weasyprint.\n\n"
      "Example:\n"
      "  holdfast report results.h5 -o report.pdf");
  auto options = std::make_shared<ReportOptions>();
  command->add_option("results", options->results_path, "Results file")->required()->type_name("FILE");
  command->add_option("-o,--output", options->output_path, "Report to write, .html or .pdf")
      ->capture_default_str()
      ->type_name("FILE");
  command->add_option("--most", options->most, "Most layouts that get a page, the worst first")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  add_memory_option(command, options->memory, kMemoryHelp);
  command->callback([options, &chosen] { chosen.run = [options] { return run_report_command(*options); }; });
}

void add_view_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("view", "Show a results file in a browser, or screen loads there");
  command->footer(
      "Writes one page that has the results in it and needs nothing else, and opens it. Without results it is\n"
      "the page that files are dropped on: it screens spreadsheets of loads itself, and shows results.\n\n"
      "Example:\n"
      "  holdfast view results.h5\n"
      "  holdfast view\n"
      "  holdfast view --serve large.h5");
  auto options = std::make_shared<ViewOptions>();
  auto* results = command->add_option("results", options->results_path, "Results file")->type_name("FILE");
  command
      ->add_option("-o,--output", options->page_path,
                   "Write the page there, instead of beside the results (.html); without results it is holdfast.html")
      ->type_name("FILE");
  command->add_flag("!--no-open", options->open, "Open no browser");
  auto* serve = command
                    ->add_flag("--serve", options->serve,
                               "Write no page: serve it to this machine alone, with results of any size, until Ctrl-C")
                    ->needs(results);
  command->add_option("--port", options->port, "Port of --serve; 0: one that is free")
      ->needs(serve)
      ->check(CLI::Range(0, 65535))
      ->type_name("N");
  add_memory_option(command, options->memory, kMemoryHelp);
  command->callback([options, &chosen] { chosen.run = [options] { return run_view_command(*options); }; });
}

}  // namespace

void add_results_commands(CLI::App& program, ChosenCommand& chosen) {
  add_merge_command(program, chosen);
  add_summary_command(program, chosen);
  add_report_command(program, chosen);
  add_view_command(program, chosen);
}

}  // namespace holdfast::internal
