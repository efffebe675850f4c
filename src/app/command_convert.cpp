#include <filesystem>
#include <iostream>
#include <vector>

#include "app/commands.hpp"
#include "app/load_config.hpp"
#include "app/report.hpp"
#include "app/screening.hpp"
#include "io/export/text_output.hpp"
#include "io/input/input_paths.hpp"
#include "io/loads/load_file.hpp"
#include "io/loads/load_writer.hpp"

namespace holdfast::internal {

ExitCode run_convert_command(const ConvertOptions& options) {
  const Result<Config> config = load_config(options.config_path);
  if (!config) return fail(ExitCode::bad_usage, config.errors());
  Settings settings = config->settings;
  if (const auto wrong = options.loads.apply_to(settings, *config)) return fail(ExitCode::bad_usage, *wrong);
  std::error_code unknown;
  if (!options.overwrite && std::filesystem::exists(options.output_path, unknown))
    return fail(ExitCode::bad_usage, {.file = options.output_path,
                                      .what = "exists already",
                                      .accepted = "another name, or --overwrite to replace it"});
  std::vector<Error> warnings;
  const auto paths = layout_paths(options.layouts, std::cin, warnings);
  if (!paths) return fail(ExitCode::bad_usage, paths.errors());
  std::vector<Layout> loads;
  std::vector<Error> errors;
  for (const std::string& path : *paths) {
    if (std::filesystem::equivalent(path, options.output_path, unknown))
      return fail(ExitCode::bad_usage,
                  {.file = options.output_path, .what = "is an input", .accepted = "another name"});
    const Result<TextFile> file = read_text_file(path);
    Result<LoadsOfFile> found = file ? read_loads(*file, settings) : Result<LoadsOfFile>(file.errors());
    if (!found) {
      errors.insert(errors.end(), found.errors().begin(), found.errors().end());
      continue;
    }
    warnings.insert(warnings.end(), found->notes.begin(), found->notes.end());
    for (ReadLoad& load : found->loads) {
      warnings.insert(warnings.end(), load.warnings.begin(), load.warnings.end());
      errors.insert(errors.end(), load.errors.begin(), load.errors.end());
      if (load.errors.empty()) loads.push_back(std::move(load.layout));
    }
  }
  warn(warnings);
  if (!errors.empty()) return fail(ExitCode::bad_usage, errors);
  const Result<std::string> text = loads_text(loads, options.output_path);
  if (!text) return fail(ExitCode::bad_usage, text.error());
  if (const auto error = write_text_file(options.output_path, *text)) return fail(ExitCode::some_failed, *error);
  print_to(stdout, "{}: {}\n", options.output_path, counted(loads.size(), "load"));
  return ExitCode::done;
}

}  // namespace holdfast::internal
