#include "parallel/screening/screening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <new>
#include <utility>

#include "parallel/schedulers/ordered_run.hpp"
#include "parallel/screening/unit_runner.hpp"
#include "parallel/screening/work_in_hand.hpp"
#include "parallel/screening/work_units.hpp"

namespace holdfast::internal {

namespace {

/// A unit between simulation and sink: what the observer is shown, and what the sink takes.
struct UnitInFlight {
  UnitRecord record;
  std::unique_ptr<SinkUnit> unit;
};

bool first_failure(const ScreeningPlan& plan) { return plan.settings.screening.first_failure; }

WorkUnits units_of(const ScreeningPlan& plan) {
  return {plan.layouts.count(), plan.accelerations.size(), plan.engine.traits(), first_failure(plan)};
}

/// What the threads of a run share.
class Run {
 public:
  Run(const ScreeningPlan& plan, ResultSink& sink, RunObserver& observer, const StopRequest& stop, StageCosts& costs)
      : plan_(plan),
        sink_(sink),
        observer_(observer),
        stop_(stop),
        costs_(costs),
        runner_(plan.engine, plan.settings, plan.record_series, plan.layouts, plan.accelerations, stop.drop, costs,
                plan.analyses),
        units_(units_of(plan)),
        failures_(plan.failures.value_or(FailureOrder(plan.accelerations.size(), plan.engine.traits()))),
        thresholds_(recording_plan(plan.settings, false).thresholds),
        first_unit_(units_.beginning_with(plan.finished_worlds)),
        next_world_(plan.finished_worlds) {
    progress_.total = plan.world_count();
    progress_.resumed = plan.finished_worlds;
    progress_.done = plan.finished_worlds;
  }

  ScreeningEnd go() {
    observer_.started(progress_);
    if (first_failure(plan_))
      run_in_blocks();
    else
      run_units(first_unit_, units_.count());
    keep(sink_.finish());
    observer_.ended();
    return {progress_.done, error_};
  }

 private:
  using Placed = std::optional<UnitInFlight>;

  void run_units(std::size_t begin, std::size_t end) {
    run_in_order(
        plan_.workers, end - begin, [&](std::size_t i) { return simulate(begin + i); },
        [&](UnitRecord&& record) { return place(record); }, [&](Placed&& unit) { return pack(std::move(unit)); },
        [&](Placed&& unit) { return write(unit); });
  }

  /// Block by block, each of which takes its order from those before it.
  void run_in_blocks() {
    for (std::size_t unit = first_unit_; unit < units_.count() && !stop_.no_more && !failed_;) {
      failures_.enter(units_[unit].layout_begin);
      std::size_t end = unit + 1;
      while (end < units_.count() && units_[end].layout_begin < failures_.block_end()) ++end;
      run_units(unit, end);
      unit = end;
    }
  }

  std::optional<UnitRecord> simulate(std::size_t i) {
    if (stop_.no_more || failed_) return std::nullopt;
    const WorkUnit unit = units_[i];
    return with_memory(unit.layout_begin, unit.acceleration_begin, "simulated", [&] {
      return runner_.run(unit, units_.sharing_layouts(i, first_unit_),
                         first_failure(plan_) ? failures_.order() : std::span<const std::size_t>());
    });
  }

  Placed place(UnitRecord& record) {
    return with_memory(record, "placed", [&] {
      const StageTimer timer(costs_, Stage::write);
      std::unique_ptr<SinkUnit> unit = sink_.place(record);
      return Placed({std::move(record), std::move(unit)});
    });
  }

  Placed pack(Placed&& unit) {
    if (!unit) return std::nullopt;
    return with_memory(unit->record, "compressed", [&] {
      const StageTimer timer(costs_, Stage::compress);
      unit->unit->pack();
      return std::move(unit);
    });
  }

  bool write(Placed& unit) {
    if (!unit) return false;
    return with_memory(unit->record, "written", [&] { return std::optional<bool>(write_and_report(*unit)); })
        .value_or(false);
  }

  bool write_and_report(UnitInFlight& unit) {
    {
      const StageTimer timer(costs_, Stage::write);
      if (auto error = unit.unit->write()) {
        keep(std::move(error));
        return false;
      }
    }
    for (const WorldRecord& world : unit.record.worlds) {
      if (first_failure(plan_)) failures_.count(world, thresholds_);
      progress_.steps += world.row.steps;
      progress_.steps_skipped += world.row.steps_skipped;
    }
    progress_.done += unit.record.worlds.size();
    for (const Error& warning : unit.record.warnings) observer_.warned(warning);
    for (const LayoutRecord& layout : unit.record.layouts) observer_.layout_begins(layout);
    if (analyses_layouts())
      for (const LayoutRecord& layout : unit.record.layouts) observer_.layout_finished(layout);
    for (const WorldRecord& world : unit.record.worlds) observer_.world_finished(world, next_world_++);
    return true;
  }

  bool analyses_layouts() const {
    return std::any_of(plan_.analyses.begin(), plan_.analyses.end(),
                       [](const AnalysisMethod* analysis) { return analysis->of_layout != nullptr; });
  }

  template <class Work>
  auto with_memory(const UnitRecord& record, const char* done, Work&& work) -> decltype(work()) {
    return with_memory(record.worlds.front().row.layout, record.worlds.front().row.acceleration, done,
                       std::forward<Work>(work));
  }

  /// Runs a stage of the unit that begins with a world. When memory runs out, there is no result, and an error is kept.
  /// @param done what the stage does to the world, in words
  template <class Work>
  auto with_memory(std::size_t layout, std::size_t acceleration, const char* done, Work&& work) -> decltype(work()) {
    const std::string& label = plan_.layouts.label(layout);
    const std::string& name = plan_.accelerations[acceleration].acceleration.name;
    const WorkInHand in_hand(label, name);
    try {
      return work();
    } catch (const std::bad_alloc&) {
      keep(out_of_memory(label, printable(fmt::format("memory ran out when its world under {} was {}", name, done))));
      return std::nullopt;
    }
  }

  /// Keeps the first error, from whichever thread.
  void keep(std::optional<Error> error) {
    const std::scoped_lock lock(error_mutex_);
    if (error && !error_) error_ = std::move(error);
    if (error_) failed_ = true;
  }

  const ScreeningPlan& plan_;
  ResultSink& sink_;
  RunObserver& observer_;
  const StopRequest& stop_;
  StageCosts& costs_;
  UnitRunner runner_;
  WorkUnits units_;
  FailureOrder failures_;  ///< changes between blocks, and in the serial stage of writing
  Thresholds thresholds_;
  std::size_t first_unit_;
  std::size_t next_world_;  ///< index of the next world to be written
  RunProgress progress_;
  std::mutex error_mutex_;
  std::optional<Error> error_;
  std::atomic<bool> failed_ = false;
};

}  // namespace

ScreeningEnd screen_worlds(const ScreeningPlan& plan, ResultSink& sink, RunObserver& observer, const StopRequest& stop,
                           StageCosts& costs) {
  return Run(plan, sink, observer, stop, costs).go();
}

bool unit_begins_with(const ScreeningPlan& plan, std::size_t world) {
  if (world == plan.world_count()) return true;
  const WorkUnits units = units_of(plan);
  return units.first_world(units.beginning_with(world)) == world;
}

}  // namespace holdfast::internal
