#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "api/engine_loader.hpp"
#include "app/commands.hpp"
#include "app/report.hpp"

namespace holdfast::internal {

namespace {

/// Why an engine cannot be used, if it cannot. An engine that runs on devices lists them only when `devices` is set.
std::optional<Error> why_missing(const EngineEntry& entry, bool devices) {
  if (!devices) return why_not_loadable(entry);
  const auto engine = make_engine(std::string(entry.name), Settings{});
  return engine ? std::nullopt : std::optional(engine.error());
}

}  // namespace

ExitCode run_engines_command(bool devices) {
  for (const EngineEntry& entry : engine_registry()) {
    const std::optional<Error> missing = why_missing(entry, devices);
    print_to(stdout, "{:<14} {}\n", entry.name, missing ? "missing: " + missing->message() : entry.sentence);
    if (!runs_on_devices(entry)) continue;
    const std::vector<std::string> lines =
        devices ? engine_devices(entry) : std::vector<std::string>{"`holdfast engines --devices` looks for devices"};
    for (const std::string& line : lines) print_to(stdout, "{:<14}   {}\n", "", line);
  }
  return ExitCode::done;
}

}  // namespace holdfast::internal
