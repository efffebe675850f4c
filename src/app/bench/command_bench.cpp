#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

#include "api/engine_loader.hpp"
#include "app/bench/bench_table.hpp"
#include "app/commands.hpp"
#include "app/load_config.hpp"
#include "app/report.hpp"
#include "app/stop_signal.hpp"
#include "io/export/text_output.hpp"
#include "io/input/input_paths.hpp"
#include "io/input/text_file.hpp"
#include "io/loads/load_file.hpp"
#include "parallel/schedulers/scheduler.hpp"

namespace holdfast::internal {

namespace {

/// A folder for results, gone when the benchmark ends.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& above) {
    path_ = (std::filesystem::path(above) / "holdfast-bench-XXXXXX").string();
    if (::mkdtemp(path_.data()) == nullptr) path_.clear();
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Layouts by their number of boxes: one set per class that has any, named after its limits.
Result<std::vector<BenchCase>> sets_by_boxes(const BenchOptions& options, const std::vector<std::string>& layouts,
                                             const Settings& settings) {
  std::vector<std::size_t> limits = options.classes;
  std::sort(limits.begin(), limits.end());
  std::vector<BenchCase> sets(limits.size() + 1);
  for (std::size_t i = 0; i <= limits.size(); ++i) {
    const std::size_t least = i == 0 ? 1 : limits[i - 1];
    sets[i].set =
        i == limits.size() ? fmt::format("{}+ boxes", least) : fmt::format("{}-{} boxes", least, limits[i] - 1);
  }
  for (const std::string& path : layouts) {
    const Result<TextFile> file = read_text_file(path);
    if (!file) return file.errors();
    const Result<LoadsOfFile> loads = read_loads(*file, settings);
    if (!loads) return loads.errors();
    std::size_t boxes = 0;  // of the largest load
    for (const ReadLoad& load : loads->loads) {
      if (!load.errors.empty()) return load.errors;
      boxes = std::max(boxes, load.layout.boxes.size());
    }
    const auto limit = std::upper_bound(limits.begin(), limits.end(), boxes);
    sets[static_cast<std::size_t>(limit - limits.begin())].layouts.push_back(path);
  }
  std::erase_if(sets, [](const BenchCase& set) { return set.layouts.empty(); });
  return sets;
}

/// An error that would end the runs, or the writing of their table: reported before anything is measured.
std::optional<Error> check(const BenchOptions& options, const Settings& settings) {
  for (const std::string& engine : options.engines)
    if (const auto made = make_engine(engine, settings); !made) return made.error();
  return options.csv_path ? check_bench_csv(*options.csv_path) : std::nullopt;
}

/// All layouts with every engine and number of threads; with the most threads also without series, and class by class.
std::vector<BenchRow> all_rows(const BenchOptions& options, const std::vector<std::string>& layouts,
                               const std::vector<BenchCase>& sets) {
  std::vector<BenchRow> rows;
  const int most = *std::max_element(options.threads.begin(), options.threads.end());
  for (const std::string& engine : options.engines) {
    for (const int threads : options.threads)
      rows.push_back({{.engine = engine, .set = "all", .layouts = layouts, .threads = threads}, {}});
    rows.push_back({{.engine = engine, .set = "all", .layouts = layouts, .threads = most, .series = false}, {}});
    for (const BenchCase& set : sets) {
      rows.push_back({set, {}});
      rows.back().bench_case.engine = engine;
      rows.back().bench_case.threads = most;
    }
  }
  return rows;
}

}  // namespace

ExitCode run_bench_command(const BenchOptions& options) {
  const Result<Config> config = load_config(options.config_path);
  if (!config) return fail(ExitCode::bad_usage, config.errors());
  std::vector<Error> warnings;
  const auto layouts = layout_paths(options.layouts, std::cin, warnings);
  if (!layouts) return fail(ExitCode::bad_usage, layouts.errors());
  const auto accelerations = acceleration_paths(options.accelerations, std::cin, warnings);
  if (!accelerations) return fail(ExitCode::bad_usage, accelerations.errors());
  warn(warnings);
  if (const auto error = check(options, config->settings)) return fail(ExitCode::bad_usage, *error);
  const auto sets =
      options.classes.empty() ? Result(std::vector<BenchCase>()) : sets_by_boxes(options, *layouts, config->settings);
  if (!sets) return fail(ExitCode::bad_usage, sets.errors());
  const StopSignal& stop = watch_stop_signals();
  std::error_code missing;
  const std::string above = options.folder.value_or(std::filesystem::temp_directory_path(missing).string());
  if (above.empty()) {
    return fail(ExitCode::bad_usage, {.what = "there is no temporary folder",
                                      .value = missing.message(),
                                      .accepted = "set TMPDIR, or give a --folder"});
  }
  const ScratchFolder scratch(above);
  if (scratch.path().empty()) return fail(ExitCode::bad_usage, {.file = above, .what = "no folder can be made in it"});

  std::vector<BenchRow> rows = all_rows(options, *layouts, *sets);
  const BenchInputs inputs{options.config_path, *accelerations, scratch.path()};
  // Repetitions of the cases are interleaved, so that other load of the machine affects all cases alike.
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    for (BenchRow& row : rows) {
      const BenchCase& c = row.bench_case;
      print_to(stderr, "run {} of {}: {}, {}, {} threads{}\n", repeat + 1, options.repeats, c.engine, c.set, c.threads,
               c.series ? "" : ", no series");
      Result<BenchSample> sample = run_bench_case(c, inputs, stop.no_more);
      if (stop.no_more) {
        print_to(stderr, "stopped; an incomplete benchmark reports nothing\n");
        return exit_code_of(stop);
      }
      if (!sample) return fail(ExitCode::some_failed, sample.errors());
      row.samples.push_back(std::move(*sample));
    }
  }
  if (const auto error = check_same_results(rows)) return fail(ExitCode::some_failed, *error);
  print_to(stdout, "{}", bench_tables(rows));
  if (options.csv_path) {
    if (const auto error = write_text_file(*options.csv_path, bench_csv(rows)))
      return fail(ExitCode::some_failed, *error);
  }
  return ExitCode::done;
}

}  // namespace holdfast::internal
