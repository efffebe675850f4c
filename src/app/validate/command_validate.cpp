#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>

#include "api/engine_loader.hpp"
#include "app/commands.hpp"
#include "app/program_folder.hpp"
#include "app/report.hpp"
#include "app/shared_script.hpp"
#include "app/stop_signal.hpp"
#include "app/validate/validation_files.hpp"
#include "app/validate/validation_run.hpp"
#include "core/base/closest_word.hpp"
#include "io/input/input_paths.hpp"
#include "io/input/layout_reader.hpp"
#include "parallel/schedulers/scheduler.hpp"
#include "validate/laboratory/engine_settings.hpp"

namespace holdfast::internal {

namespace {

const std::vector<std::string> kSuites = {"slide", "tip", "rebound", "manoeuvre", "hard", "oscillate", "load"};

/// Measurements up to which each is printed; above, a table of how many pass.
constexpr std::size_t kRowsShown = 60;

bool is_wanted(const std::vector<std::string>& wanted, const std::string& name) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

Error unknown(const std::string& kind, const std::string& name, const std::vector<std::string>& known) {
  const auto meant = closest_word(name, std::vector<std::string_view>(known.begin(), known.end()));
  return {.what = "unknown " + kind,
          .value = name,
          .accepted = meant ? fmt::format("did you mean '{}'?", *meant)
                            : fmt::format("accepted are {}", fmt::join(known, ", "))};
}

/// The real loads: packed layouts, without the small example and those that are unstable from the start.
Result<std::vector<LoadWorld>> read_loads(const std::vector<std::string>& paths) {
  std::vector<Error> warnings;
  const auto files = layout_paths(paths, std::cin, warnings);
  if (!files) return files.errors();
  std::vector<Layout> layouts;
  for (const std::string& path : *files) {
    const std::string name = std::filesystem::path(path).filename().string();
    if (name.starts_with("unstable") || name == "seed_example.txt") continue;
    const Result<TextFile> file = read_text_file(path);
    if (!file) return file.errors();
    Result<Layout> layout = parse_layout(*file, Settings{}, warnings);
    if (!layout) return layout.errors();
    layouts.push_back(std::move(*layout));
  }
  return load_worlds(layouts);
}

/// Leaves out the settings of engines that cannot be used here, and says so; an error if such an engine was asked for.
std::optional<Error> leave_out_missing(const ValidateOptions& options, ValidationPlan& plan) {
  std::map<std::string, std::optional<Error>> problems;
  for (const EngineSetting& setting : plan.settings) {
    if (problems.contains(setting.engine)) continue;
    const auto engine = make_engine(setting.engine, Settings{});
    std::optional<Error>& problem = problems[setting.engine];
    if (engine) continue;
    problem = engine.error();
    if (!options.engines.empty()) return problem;
    print_to(stderr, "left out: {}: {}\n", setting.engine, problem->message());
  }
  std::erase_if(plan.settings, [&](const EngineSetting& setting) { return problems.at(setting.engine).has_value(); });
  return std::nullopt;
}

Result<ValidationPlan> plan_of(const ValidateOptions& options) {
  ValidationPlan plan;
  plan.threads = thread_count(options.threads);
  plan.quiet = options.json;
  std::vector<std::string> engines;
  for (const EngineSetting& setting : engine_settings()) {
    if (!is_wanted(engines, setting.engine) || engines.empty()) engines.push_back(setting.engine);
    if (is_wanted(options.engines, setting.engine) && (setting.quick || !options.quick))
      plan.settings.push_back(setting);
  }
  for (const std::string& engine : options.engines)
    if (!is_wanted(engines, engine)) return unknown("engine", engine, engines);
  for (const std::string& suite : options.suites)
    if (!is_wanted(kSuites, suite)) return unknown("suite", suite, kSuites);

  if (const auto error = leave_out_missing(options, plan)) return *error;

  const std::vector<std::string> names = validation_cases();
  for (Case& known : all_cases()) {
    const bool named = !options.case_name || known.name == *options.case_name;
    if (named && is_wanted(options.suites, known.suite) && (known.quick || !options.quick)) plan.cases.push_back(known);
  }
  if (options.case_name && !is_wanted(names, *options.case_name)) return unknown("case", *options.case_name, names);

  const bool loads =
      is_wanted(options.suites, "load") && !options.quick && (!options.case_name || *options.case_name == "real_loads");
  if (loads) {
    Result<std::vector<LoadWorld>> worlds = read_loads(options.layouts);
    if (!worlds) return worlds.errors();
    plan.loads = std::move(*worlds);
  }
  if (plan.settings.empty() || (plan.cases.empty() && plan.loads.empty()))
    return Error{.what = "nothing to validate", .accepted = "this choice of engine, suite, case and --quick is empty"};
  return plan;
}

void print_rows(std::span<const ValidationRow> rows) {
  for (const ValidationRow& row : rows) {
    const Measurement& m = row.measurement;
    print_to(stdout, "{} {}, {}, {}: {:.6g}, expected {:.6g}, error {:.2g} of {:g}: {}\n", row.engine, row.setting,
             row.case_name, m.metric, m.value, m.expected, m.error, tolerance_of(m.tolerance),
             m.passes() ? "pass" : "fail");
  }
}

/// How many measurements pass: one line per setting, one column per suite.
void print_table(const ValidationResult& result) {
  std::vector<std::pair<std::string, std::string>> settings;
  std::map<std::tuple<std::string, std::string, std::string>, std::pair<int, int>> passed;
  for (const ValidationRow& row : result.rows) {
    const std::pair setting(row.engine, row.setting);
    if (std::find(settings.begin(), settings.end(), setting) == settings.end()) settings.push_back(setting);
    auto& [pass, all] = passed[{row.engine, row.setting, row.suite}];
    pass += row.measurement.passes() ? 1 : 0;
    ++all;
  }
  print_to(stdout, "\n{:<13} {:<16}", "passed of", "");
  for (const std::string& suite : kSuites) print_to(stdout, " {:>9}", suite);
  print_to(stdout, " {:>16}\n", "µs/box/s of time");
  for (const auto& [engine, setting] : settings) {
    print_to(stdout, "{:<13} {:<16}", engine, setting);
    for (const std::string& suite : kSuites) {
      const auto found = passed.find({engine, setting, suite});
      print_to(stdout, " {:>9}",
               found == passed.end() ? "-" : fmt::format("{}/{}", found->second.first, found->second.second));
    }
    RunCost cost;
    for (const SuiteCost& entry : result.costs) {
      if (entry.engine != engine || entry.setting != setting) continue;
      cost.cpu_seconds += entry.cost.cpu_seconds;
      cost.box_seconds += entry.cost.box_seconds;
    }
    print_to(stdout, " {:>16.0f}\n", 1e6 * cost.cpu_seconds / cost.box_seconds);
  }
}

/// Draws the report with the Python script that comes with the program.
std::optional<Error> draw_report(const std::string& folder) {
  if (run_shared_script("validation_report.py", {folder}) == 0) return std::nullopt;
  return Error{.what = "the report could not be drawn",
               .accepted = "python3 with matplotlib and pandas is needed; the numbers are in " + folder};
}

ExitCode judge_bounds(const ValidateOptions& options, const ValidationResult& result) {
  const std::string path = options.bounds_path.value_or((share_folder() / "validation_bounds.tsv").string());
  const Result<Bounds> bounds = read_bounds(path);
  if (!bounds) return fail(ExitCode::bad_usage, bounds.errors());
  const std::vector<ValidationRow> above = missed(result.rows, *bounds);
  if (above.empty()) return ExitCode::done;
  print_to(stderr, "{} measurements miss their recorded bounds (or have none):\n", above.size());
  for (const ValidationRow& row : above) {
    const auto bound = bounds->find({row.engine, row.setting, row.case_name, row.measurement.metric});
    print_to(stderr, "  {} {}, {}, {}: error {:.3g}, {}\n", row.engine, row.setting, row.case_name,
             row.measurement.metric, row.measurement.error,
             bound == bounds->end() ? "no bound" : fmt::format("bound {:.3g}", bound->second));
  }
  return ExitCode::some_failed;
}

}  // namespace

std::vector<std::string> validation_suites() { return kSuites; }

std::vector<std::string> validation_cases() {
  std::vector<std::string> names = {"real_loads"};
  for (const Case& known : all_cases()) names.push_back(known.name);
  return names;
}

ExitCode run_validate_command(const ValidateOptions& options) {
  const StopSignal& stop = watch_stop_signals();
  const Result<ValidationPlan> plan = plan_of(options);
  if (!plan) return fail(ExitCode::bad_usage, plan.errors());
  if (options.record_path) {
    if (const auto error = check_bounds_file(*options.record_path)) return fail(ExitCode::bad_usage, *error);
  }
  const ValidationResult result = run_validation(*plan, stop.no_more);
  if (!result.complete) {
    print_to(stderr, "stopped; an incomplete validation keeps nothing\n");
    return exit_code_of(stop);
  }
  if (options.json) {
    print_to(stdout, "{}\n", validation_json(result.rows));
  } else {
    if (result.rows.size() <= kRowsShown) print_rows(result.rows);
    print_table(result);
  }
  if (options.folder) {
    if (const auto error = write_validation(*options.folder, result.rows, result.costs))
      return fail(ExitCode::some_failed, *error);
    if (const auto error = draw_report(*options.folder)) return fail(ExitCode::some_failed, *error);
    if (!options.json) print_to(stdout, "report: {}/index.html\n", *options.folder);
  }
  if (options.record_path) {
    if (const auto error = write_bounds(*options.record_path, result.rows)) return fail(ExitCode::some_failed, *error);
    return ExitCode::done;
  }
  return judge_bounds(options, result);
}

}  // namespace holdfast::internal
