#include "api/recorded_run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "analyses/analysis.hpp"
#include "api/version.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/model/setting_table.hpp"
#include "io/input/text_file.hpp"
#include "io/results/results_assembler.hpp"
#include "io/results/results_removal.hpp"
#include "io/results/results_resume.hpp"
#include "io/results/results_writer.hpp"
#include "parallel/schedulers/ticker.hpp"

namespace holdfast::internal {

namespace {

using Kind = RecordedEnd::Kind;

/// How often the writer looks whether the open part is due.
constexpr std::chrono::milliseconds kPartInterval(250);

std::string host_name() {
  std::array<char, 256> name = {};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// What is finished must be the first worlds of this run, up to the end of a unit of work, and all layouts must be
/// what they were when the run began.
std::optional<Error> check_continues(const Progress& finished, const ScreeningPlan& plan, const Recording& recording) {
  if (finished.part_count == 0 && !finished.complete) return std::nullopt;
  const std::vector<std::string>& hashes = recording.description.layout_hashes;
  const std::size_t accelerations = plan.accelerations.size();
  const std::size_t world = finished.world_count;
  if (world > plan.world_count() || finished.layout_count != (world + accelerations - 1) / accelerations ||
      finished.layout_hashes.size() != hashes.size() || !unit_begins_with(plan, world)) {
    return Error{.file = recording.path,
                 .what = "cannot resume: the finished worlds do not end where a unit of work of this engine ends",
                 .value = fmt::format("{} of {} worlds", world, plan.world_count()),
                 .accepted = "--overwrite starts anew"};
  }
  const auto [then, now] = std::mismatch(finished.layout_hashes.begin(), finished.layout_hashes.end(), hashes.begin());
  if (now == hashes.end()) return std::nullopt;
  return Error{.file = plan.layouts.label(static_cast<std::size_t>(now - hashes.begin())),
               .what = "this layout has changed since the run that is to be resumed",
               .accepted = "put the old file back, or start anew with --overwrite"};
}

/// Reports the worlds that an earlier run finished as that run reported them.
std::optional<Error> report_finished(const Recording& recording, const Progress& finished, RunObserver& observer) {
  const RunDescription& run = recording.description;
  std::size_t index = 0;
  const auto report_world = [&](const WorldRecord& world) {
    // Names come from this run's inputs; a world that has none there belongs to a damaged file.
    if (world.row.layout >= run.layout_names.size() || world.row.acceleration >= run.accelerations.size()) return;
    observer.world_finished(world, index++);
  };
  return visit_finished(recording.path, finished,
                        {.world = report_world,
                         .layout_begins = [&](const LayoutRecord& layout) { observer.layout_begins(layout); },
                         .layout = [&](const LayoutRecord& layout) { observer.layout_finished(layout); }});
}

/// Counts the failures of the finished worlds as the run that finished them did.
std::optional<Error> count_failures(const Recording& recording, const Progress& finished, ScreeningPlan& plan) {
  FailureOrder& failures = plan.failures.emplace(plan.accelerations.size(), plan.engine.traits());
  const auto count_world = [&](const WorldRecord& world) {
    if (world.row.acceleration >= plan.accelerations.size()) return;  // of a damaged file
    failures.enter(world.row.layout);
    failures.count(world, recording.description.thresholds);
  };
  return visit_finished(recording.path, finished, {.world = count_world});
}

/// Adds what a resumed run would find. What was written to the part that failed is lost: only finished parts count.
void add_what_is_safe(const Recording& recording, RecordedEnd& end) {
  std::error_code unknown;
  end.parts_are_gone = !std::filesystem::exists(recording.path + ".parts", unknown);
  if (end.parts_are_gone) return;
  const Result<Progress> safe = find_finished(recording.path, fingerprint(recording.description));
  if (safe)
    end.safe_worlds = safe->world_count;
  else
    end.errors.insert(end.errors.end(), safe.errors().begin(), safe.errors().end());
}

RecordedEnd refused(std::vector<Error> errors) { return {.kind = Kind::refused, .errors = std::move(errors)}; }

/// Closes the open part in time although no world finishes.
auto part_closer(ResultsWriter& writer) {
  return std::make_unique<Ticker>(kPartInterval, [&writer] {
    try {
      // An error is kept by the writer, and returned by its next write.
      static_cast<void>(writer.close_part_if_due(std::chrono::steady_clock::now()));
    } catch (const std::bad_alloc&) {
      // The next tick may find room.
    }
  });
}

}  // namespace

RecordedEnd record_run(ScreeningPlan plan, const Recording& recording, const OutputLock& /*lock*/,
                       RunObserver& observer, const StopRequest& stop, StageCosts& costs) {
  if (recording.existing == ExistingResults::overwrite) {
    if (const auto error = remove_results(recording.path)) return refused({*error});
  }
  RecordedEnd end;
  end.total = plan.world_count();
  Progress finished;
  if (recording.existing == ExistingResults::resume) {
    const Result<Progress> found = find_finished(recording.path, fingerprint(recording.description));
    if (!found) return refused(found.errors());
    finished = *found;
    if (const auto error = check_continues(finished, plan, recording)) return refused({*error});
    if (recording.report_finished) {
      if (const auto error = report_finished(recording, finished, observer)) return refused({*error});
    }
    end.was_complete = finished.complete;
    end.done = finished.world_count;
    if (finished.complete) return end;
    if (plan.settings.screening.first_failure) {
      if (const auto error = count_failures(recording, finished, plan)) return refused({*error});
    }
  }
  {
    const Result<std::unique_ptr<ResultsWriter>> writer =
        ResultsWriter::open(recording.path, recording.description, finished);
    if (!writer) return refused(writer.errors());
    plan.finished_worlds = finished.world_count;
    const auto closer = part_closer(**writer);
    const ScreeningEnd run = screen_worlds(plan, **writer, observer, stop, costs);
    end.done = run.done;
    if (run.error) end.errors.push_back(*run.error);
  }
  if (end.errors.empty() && end.done < end.total) {
    end.kind = Kind::stopped;
    return end;
  }
  if (end.errors.empty()) {
    const StageTimer timer(costs, Stage::assemble);
    if (const auto error = assemble(recording.path, recording.description, &stop.no_more)) {
      if (stop.no_more) {
        end.kind = Kind::stopped;
        return end;
      }
      end.errors.push_back(*error);
    }
  }
  if (!end.errors.empty()) {
    end.kind = Kind::failed;
    add_what_is_safe(recording, end);
  }
  return end;
}

std::string hash_of(const Acceleration& acceleration) {
  std::string bytes;
  const auto append = [&](const double* data, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(data), count * sizeof(double));
  };
  for (const Segment& segment : acceleration.segments) {
    append(&segment.start, 1);
    append(&segment.duration, 1);
    append(segment.acceleration.data(), 3);
  }
  return sha256_of(bytes);
}

RunDescription describe_run(const Settings& settings, std::vector<std::string> layout_names,
                            std::vector<std::string> hashes, std::span<const ReadAcceleration> accelerations,
                            bool record_series) {
  RunDescription run;
  run.software = fmt::format("holdfast {}", kVersion);
  run.git_commit = kGitCommit;
  run.engine = settings.screening.engine;
  run.created_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  run.host = host_name();
  run.settings = effective_settings(settings);
  run.layout_names = std::move(layout_names);
  run.layout_hashes = std::move(hashes);
  for (const ReadAcceleration& read : accelerations) run.accelerations.push_back(read.acceleration);
  run.analyses = tables_of(analyses_of(settings));
  run.record_series = record_series;
  run.thresholds = recording_plan(settings, true).thresholds;
  return run;
}

}  // namespace holdfast::internal
