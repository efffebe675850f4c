#include "app/run_inputs.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "api/recorded_run.hpp"
#include "app/report.hpp"
#include "core/model/norms.hpp"
#include "io/input/acceleration_reader.hpp"
#include "io/input/text_file.hpp"
#include "parallel/screening/world_limits.hpp"

namespace holdfast::internal {

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

std::optional<Error> many_steps_warning(const std::string& label, const Acceleration& acceleration,
                                        const Settings& settings, double steps_per_second) {
  const double steps = most_steps(acceleration, settings, steps_per_second);
  if (steps <= kManySteps) return std::nullopt;
  return Error{.file = label, .what = "a world takes very many steps", .value = fmt::format("up to {:.2g}", steps)};
}

std::vector<ReadAcceleration> read_accelerations(const ScreeningJob& job, double steps_per_second) {
  std::vector<ReadAcceleration> accelerations;
  const auto take = [&](const std::string& label, Result<Acceleration> acceleration) {
    if (acceleration) {
      auto error = check_steps(label, *acceleration, job.settings, steps_per_second);
      if (!error && job.record_series) error = check_samples(label, *acceleration, job.settings);
      const auto many = many_steps_warning(label, *acceleration, job.settings, steps_per_second);
      if (!error && many) warn(std::span(&*many, 1));
      if (error) acceleration = *error;
    }
    if (acceleration) {
      accelerations.back().acceleration = std::move(*acceleration);
    } else {
      accelerations.back().error = acceleration.error().message();
      for (const Error& error : acceleration.errors()) print_to(stderr, "{}\n", error.message());
    }
  };
  if (!job.settings.screening.norm.empty()) {
    for (Acceleration& made : find_norm(job.settings.screening.norm)->accelerations()) {
      const std::string name = made.name;
      made.sha256 = hash_of(made);
      accelerations.push_back({{name, made.sha256, {}}, ""});
      take(name, std::move(made));
    }
  }
  if (accelerations.empty() && job.acceleration_paths.empty()) accelerations.push_back({gravity_alone(), ""});
  for (const std::string& path : job.acceleration_paths) {
    const Result<TextFile> file = read_text_file(path);
    std::vector<Error> warnings;
    accelerations.push_back({{input_name(path), file ? file->sha256 : "", {}}, ""});
    take(path, file ? parse_acceleration(*file, warnings) : Result<Acceleration>(file.errors()));
    warn(warnings);
  }
  return accelerations;
}

RunDescription describe_run(const ScreeningJob& job, const LayoutFiles& layouts,
                            const std::vector<ReadAcceleration>& accelerations) {
  RunDescription run = describe_run(job.settings, layouts.names(), layouts.hashes(), accelerations, job.record_series);
  run.command_line = job.command_line;
  run.config_text = job.config_text;
  run.shard = job.shard;
  return run;
}

}  // namespace holdfast::internal
