#include <fmt/format.h>

#include <iostream>
#include <optional>

#include "app/commands.hpp"
#include "app/load_config.hpp"
#include "app/report.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/input_paths.hpp"
#include "io/input/layout_reader.hpp"

namespace holdfast::internal {

namespace {

/// What is wrong with a file, and in a few words what it is.
struct Finding {
  std::vector<Error> errors;
  std::vector<Error> warnings;
  std::string description;
};

template <class T>
void take(Finding& finding, const Result<T>& result, const std::function<std::string(const T&)>& describe) {
  if (result) {
    finding.description = describe(*result);
  } else {
    finding.errors = result.errors();
  }
}

Finding check_file(const InputFile& input, const Settings& settings) {
  Finding finding;
  const Result<TextFile> file = read_text_file(input.path);
  if (!file) return {.errors = file.errors()};
  switch (input.kind) {
    case InputKind::layout:
      take<Layout>(finding, parse_layout(*file, settings, finding.warnings),
                   [](const Layout& layout) { return fmt::format("layout, {} boxes", layout.boxes.size()); });
      break;
    case InputKind::acceleration:
      take<Acceleration>(finding, parse_acceleration(*file, finding.warnings), [](const Acceleration& acceleration) {
        return fmt::format("acceleration, {} segments, {:g} s", acceleration.segments.size(), acceleration.end_time());
      });
      break;
    case InputKind::config:
      take<Config>(finding, parse_config(*file, finding.warnings),
                   [](const Config& config) { return fmt::format("config, {} keys", config.given.size()); });
      break;
    case InputKind::unknown:
      finding.errors.push_back({.file = input.path,
                                .what = "neither layout, acceleration nor config",
                                .accepted = "a layout has 7 columns, an acceleration 5, a config [sections]"});
  }
  return finding;
}

}  // namespace

ExitCode run_check_command(const CheckOptions& options) {
  const Result<Config> config = load_config(options.config_path);
  if (!config) return fail(ExitCode::bad_usage, config.errors());
  std::vector<Error> warnings;
  const auto inputs = find_inputs(options.paths, std::cin, warnings);
  if (!inputs) return fail(ExitCode::bad_usage, inputs.errors());
  warn(warnings);

  std::size_t bad = 0;
  for (const InputFile& input : *inputs) {
    const Finding finding = check_file(input, config->settings);
    warn(finding.warnings);
    fail(ExitCode::bad_usage, finding.errors);
    bad += finding.errors.empty() ? 0U : 1U;
    if (finding.errors.empty()) print_to(stdout, "{}: ok: {}\n", input.path, finding.description);
  }
  if (bad > 0) print_to(stderr, "{} of {} files are bad\n", bad, inputs->size());
  return bad == 0 ? ExitCode::done : ExitCode::bad_usage;
}

}  // namespace holdfast::internal
