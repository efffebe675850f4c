#include "app/world_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <new>

#include "app/report.hpp"
#include "app/run_inputs.hpp"
#include "app/screening/work_units.hpp"
#include "app/ticker.hpp"
#include "app/uncaught.hpp"
#include "app/world_json.hpp"
#include "parallel/schedulers/ordered_run.hpp"

namespace holdfast {

namespace {

constexpr std::size_t kWarningsShown = 20;

WorldPlace first_world(const UnitRecord& record) {
  return {record.worlds.front().layout, record.worlds.front().acceleration};
}

}  // namespace

WorldRun::WorldRun(const ScreeningJob& job, const Engine& engine, const std::vector<std::string>& layout_hashes,
                   const std::vector<RunAcceleration>& accelerations, ResultsWriter& writer, const Progress& finished,
                   StageCosts& costs)
    : job_(job),
      engine_(engine),
      layout_hashes_(layout_hashes),
      accelerations_(accelerations),
      writer_(writer),
      costs_(costs),
      world_(finished.world_count),
      thresholds_(recording_plan(job.settings, true).thresholds) {
  counts_.total = job.layout_paths.size() * accelerations.size();
  counts_.resumed = finished.world_count;
  counts_.done = finished.world_count;
}

template <class Work>
auto WorldRun::with_memory(WorldPlace world, const char* done, Work&& work) -> decltype(work()) {
  const WorkInHand in_hand(job_.layout_paths[world.layout], accelerations_[world.acceleration].acceleration.name);
  try {
    return work();
  } catch (const std::bad_alloc&) {
    keep(out_of_memory(job_.layout_paths[world.layout],
                       printable(fmt::format("memory ran out when its world under {} was {}",
                                             accelerations_[world.acceleration].acceleration.name, done))));
    return std::nullopt;
  }
}

bool WorldRun::go() {
  const WorkUnits units(job_.layout_paths.size(), accelerations_.size(), engine_.traits());
  UnitRunner runner(engine_, job_.settings, job_.record_series, job_.layout_paths, layout_hashes_, accelerations_,
                    stop_.drop, costs_);
  const std::size_t first = units.beginning_with(world_);
  {
    ProgressLine line(counts_, stderr, job_.quiet);
    const Ticker ticker(std::chrono::milliseconds(250), [&] {
      try {
        tick(line);
      } catch (const std::bad_alloc&) {
        // What is told can wait for the next tick, when there may be room.
      }
    });
    // No exception leaves a stage. A unit for which memory runs out ends the run as one that could not be written does:
    // those before it in the file are kept.
    using Placed = std::optional<PlacedUnit>;
    using Packed = std::optional<PackedUnit>;
    const auto work = [&](std::size_t i) -> std::optional<UnitRecord> {
      if (stop_.no_more || failed_) return std::nullopt;
      const WorkUnit unit = units[first + i];
      return with_memory({unit.layout_begin, unit.acceleration_begin}, "simulated",
                         [&] { return runner.run(unit, units.sharing_layouts(first + i, first)); });
    };
    const auto place = [&](UnitRecord&& record) -> Placed {
      return with_memory(first_world(record), "put in its place", [&] {
        announce(record);
        const StageTimer timer(costs_, Stage::write);
        return Placed(writer_.place(std::move(record)));
      });
    };
    const auto pack = [&](Placed&& unit) -> Packed {
      if (!unit) return std::nullopt;
      return with_memory(first_world(unit->record), "compressed", [&] {
        const StageTimer timer(costs_, Stage::compress);
        return Packed(ResultsWriter::pack(std::move(*unit)));
      });
    };
    const auto write_packed = [&](Packed&& unit) {
      if (!unit) return false;
      const auto written = with_memory(first_world(unit->record), "written",
                                       [&] { return std::optional<bool>(write(std::move(*unit))); });
      return written.value_or(false);
    };
    run_in_order(*scheduler_of(job_.settings.screening.scheduler), thread_count(job_.settings.screening.threads),
                 units.count() - first, work, place, pack, write_packed);
    keep(writer_.finish());
  }
  if (warning_count_ > kWarningsShown)
    print_to(stderr, "and {} more warnings; `holdfast check` prints all\n", warning_count_ - kWarningsShown);
  if (error_) print_to(stderr, "{}\n", error_->message());
  return !error_ && counts_.done == counts_.total;
}

void WorldRun::announce(const UnitRecord& record) {
  const std::scoped_lock lock(notes_mutex_);
  for (const Error& warning : record.warnings)
    if (!job_.quiet && ++warning_count_ <= kWarningsShown) notes_.push_back("warning: " + warning.message());
  for (const WorldRecord& world : record.worlds) {
    const std::string layout = input_name(job_.layout_paths[world.layout]);
    const std::string& acceleration = accelerations_[world.acceleration].acceleration.name;
    if (job_.json) lines_ += world_json(world, layout, acceleration, world_, thresholds_) + "\n";
    if (has(world.outcome.status, Status::bad_layout) && world.acceleration == 0) notes_.push_back(world.status_text);
    if (has(world.outcome.status, Status::too_large)) notes_.push_back(world.status_text);
    if (has(world.outcome.status, Status::non_finite))
      notes_.push_back(printable(fmt::format("{} under {}: {}", layout, acceleration, world.status_text)));
    ++world_;
  }
}

bool WorldRun::write(PackedUnit&& unit) {
  std::uint64_t steps = 0;
  std::uint64_t skipped = 0;
  for (const WorldRecord& world : unit.record.worlds) {
    steps += world.outcome.counters.steps;
    skipped += world.outcome.counters.steps_skipped;
  }
  const std::uint64_t worlds = unit.record.worlds.size();
  {
    const StageTimer timer(costs_, Stage::write);
    if (auto error = writer_.write(std::move(unit))) {
      keep(std::move(error));
      return false;
    }
  }
  counts_.steps += steps;
  counts_.steps_skipped += skipped;
  counts_.done += worlds;
  print_lines();
  return true;
}

void WorldRun::keep(std::optional<Error> error) {
  const std::scoped_lock lock(notes_mutex_);
  if (error && !error_) error_ = std::move(error);
  if (error_) failed_ = true;
}

void WorldRun::print_lines() {
  std::string lines;
  {
    const std::scoped_lock lock(notes_mutex_);
    lines.swap(lines_);
  }
  write_unless(stop_.drop, stdout, lines);
}

void WorldRun::tick(ProgressLine& line) {
  keep(writer_.close_part_if_due(std::chrono::steady_clock::now()));
  std::vector<std::string> notes;
  {
    const std::scoped_lock lock(notes_mutex_);
    notes.swap(notes_);
  }
  for (const std::string& note : notes) line.note(note);
  if (stop_.no_more && !stop_told_) {
    line.note(stop_.drop ? "stopping" : "stopping: finishing the worlds in flight; press Ctrl-C again to drop them");
    stop_told_ = true;
  }
  line.show();
}

}  // namespace holdfast
