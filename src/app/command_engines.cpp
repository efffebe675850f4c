#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/engine_catalog.hpp"
#include "app/report.hpp"

namespace holdfast {

namespace {

ExitCode list_engines() {
  for (const EngineEntry& entry : engine_catalog()) {
    const auto engine = make_engine(entry.name, Settings{});
    print_to(stdout, "{:<14} {}\n", entry.name, engine ? entry.sentence : "missing: " + engine.error().message());
    for (const std::string& line : engine_devices(entry)) print_to(stdout, "{:<14}   {}\n", "", line);
  }
  return ExitCode::done;
}

}  // namespace

void add_engines_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("engines", "List the engines, and why one cannot be used");
  command->footer("Example:\n  holdfast engines");
  command->callback([&chosen] { chosen.run = list_engines; });
}

}  // namespace holdfast
