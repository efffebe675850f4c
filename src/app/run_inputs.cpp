#include "app/run_inputs.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "app/report.hpp"
#include "app/series_limit.hpp"
#include "app/version.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/model/setting_table.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/text_file.hpp"

namespace holdfast {

namespace {

std::string host_name() {
  std::array<char, 256> name = {};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

}  // namespace

std::string input_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

void warn_of_same_names(const std::vector<std::string>& paths) {
  std::unordered_map<std::string, std::string_view> first;
  std::optional<Error> warning;
  std::size_t count = 0;
  for (const std::string& path : paths) {
    const auto [same, is_new] = first.emplace(input_name(path), path);
    if (is_new || ++count > 1) continue;
    warning = Error{
        .file = path, .what = "has the same name in the results as", .value = printable(std::string(same->second))};
  }
  if (count > 1) warning->accepted = fmt::format("one of {} such files", count);
  if (warning) warn(std::span(&*warning, 1));
}

std::vector<RunAcceleration> read_accelerations(const ScreeningJob& job) {
  std::vector<RunAcceleration> accelerations;
  for (const std::string& path : job.acceleration_paths) {
    RunAcceleration& entry = accelerations.emplace_back();
    entry.acceleration.name = input_name(path);
    const Result<TextFile> file = read_text_file(path);
    std::vector<Error> warnings;
    Result<Acceleration> acceleration =
        file ? parse_acceleration(*file, warnings) : Result<Acceleration>(file.errors());
    if (file) entry.acceleration.sha256 = file->sha256;
    if (acceleration) {
      const auto error = job.record_series ? check_samples(path, *acceleration, job.settings) : std::nullopt;
      if (error) acceleration = *error;
    }
    if (acceleration) {
      entry.acceleration = std::move(*acceleration);
    } else {
      entry.error = acceleration.error().message();
      for (const Error& error : acceleration.errors()) print_to(stderr, "{}\n", error.message());
    }
  }
  return accelerations;
}

RunDescription describe_run(const ScreeningJob& job, const std::vector<RunAcceleration>& accelerations,
                            std::vector<std::string> layout_hashes) {
  RunDescription run;
  run.software = fmt::format("holdfast {}", kVersion);
  run.git_commit = kGitCommit;
  run.engine = job.settings.screening.engine;
  run.command_line = job.command_line;
  run.created_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  run.host = host_name();
  run.config_text = job.config_text;
  run.settings = effective_settings(job.settings);
  for (const std::string& path : job.layout_paths) run.layout_names.push_back(input_name(path));
  run.layout_hashes = std::move(layout_hashes);
  for (const RunAcceleration& acceleration : accelerations) run.accelerations.push_back(acceleration.acceleration);
  run.record_series = job.record_series;
  run.thresholds = recording_plan(job.settings, true).thresholds;
  return run;
}

}  // namespace holdfast
