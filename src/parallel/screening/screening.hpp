#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/engine/analysis_method.hpp"
#include "core/engine/engine.hpp"
#include "core/engine/result_sink.hpp"
#include "core/engine/run_inputs.hpp"
#include "core/engine/run_observer.hpp"
#include "core/model/settings.hpp"
#include "parallel/schedulers/workers.hpp"
#include "parallel/screening/failure_order.hpp"
#include "parallel/screening/stage_costs.hpp"

namespace holdfast::internal {

/// A run: every layout under every acceleration. All that it names must outlive it.
struct ScreeningPlan {
  const Engine& engine;
  const Settings& settings;
  Workers& workers;
  LayoutSource& layouts;
  std::span<const ReadAcceleration> accelerations;
  bool record_series = true;
  AnalysisMethods analyses = {};    ///< beside the verdicts
  std::size_t finished_worlds = 0;  ///< the first so many are finished already; a unit of work must begin there
  std::optional<FailureOrder> failures = std::nullopt;  ///< with FirstFailure: has counted the finished worlds

  std::size_t world_count() const { return layouts.count() * accelerations.size(); }
};

/// How a run ended.
struct ScreeningEnd {
  std::uint64_t done = 0;      ///< worlds that the sink has, those finished before the run included
  std::optional<Error> error;  ///< what kept the run from going on, if anything
};

/// Simulates the worlds of a plan in parallel and hands them to the sink in their order: layout by layout, acceleration
/// fastest. A layout or acceleration that cannot be used becomes a world with a status. Reading, placing, packing and
/// writing are the stages of one pipeline, so that memory holds a bounded number of worlds.
///
/// Throws nothing: memory that runs out in a stage ends the run with an error that names the world.
ScreeningEnd screen_worlds(const ScreeningPlan& plan, ResultSink& sink, RunObserver& observer, const StopRequest& stop,
                           StageCosts& costs);

/// Whether a unit of work begins with world `world`, so that a run can resume there; also true at the end.
bool unit_begins_with(const ScreeningPlan& plan, std::size_t world);

}  // namespace holdfast::internal
