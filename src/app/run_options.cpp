#include "app/run_options.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>
#include <utility>
#include <vector>

#include "app/norm_option.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/model/setting_table.hpp"
#include "parallel/schedulers/scheduler.hpp"

namespace holdfast::internal {

namespace {

/// Reads `K/N`.
std::optional<ShardChoice> parse_part(const std::string& text) {
  ShardChoice choice;
  const char* const end = text.data() + text.size();
  const auto [slash, bad_part] = std::from_chars(text.data(), end, choice.part);
  if (bad_part != std::errc() || slash == end || *slash != '/') return std::nullopt;
  const auto [rest, bad_parts] = std::from_chars(slash + 1, end, choice.parts);
  if (bad_parts != std::errc() || rest != end || choice.part < 1 || choice.part > choice.parts) return std::nullopt;
  return choice;
}

}  // namespace

std::optional<Error> RunOptions::apply_to(ScreeningJob& job, const Config& config) const {
  ScreeningSettings& screening = job.settings.screening;
  if (auto wrong = apply_norm(norm, job.settings)) return wrong;
  if (auto wrong = loads.apply_to(job.settings, config)) return wrong;
  screening.engine = engine.value_or(screening.engine);
  screening.threads = threads.value_or(screening.threads);
  if (scheduler) {
    const SettingKey& key = *find_setting("Screening", "Scheduler");
    if (!key.set(job.settings, "", *scheduler))
      return Error{.what = "unknown scheduler",
                   .value = *scheduler,
                   .accepted = fmt::format("accepted are {}", fmt::join(scheduler_names(), ", "))};
  }
  // The command line has checked it.
  if (stop_when) static_cast<void>(find_setting("Screening", "StopWhen")->set(job.settings, "", *stop_when));
  if (walls) static_cast<void>(find_setting("Screening", "Walls")->set(job.settings, "", *walls));
  if (replicas) static_cast<void>(find_setting("Screening", "Replicas")->set(job.settings, "", *replicas));
  for (const std::string_view key : analyses)
    static_cast<void>(find_setting("Screening", key)->set(job.settings, "", "true"));
  if (first_failure) screening.first_failure = true;
  if (text_folder) job.text_folder = text_folder;
  if (part) {
    job.part = parse_part(*part);
    if (!job.part)
      return Error{.what = "no shard", .value = *part, .accepted = "K/N, the K-th of N shards, with K from 1 to N"};
  }
  job.costs_path = costs_path;
  job.record_series = !no_series;
  if (resume) job.existing = ExistingResults::resume;
  if (overwrite) job.existing = ExistingResults::overwrite;
  job.json = json;
  job.quiet = quiet;
  if (auto wrong = apply_accuracy(job.settings)) return wrong;
  std::vector<SettingConflict> conflicts = check_settings(job.settings);
  return conflicts.empty() ? std::nullopt : std::optional(std::move(conflicts.front().error));
}

std::optional<Error> RunOptions::apply_accuracy(Settings& settings) const {
  return accuracy ? set_accuracy(settings, *accuracy) : std::nullopt;
}

}  // namespace holdfast::internal
