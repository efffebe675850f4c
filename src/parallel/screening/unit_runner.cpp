#include "parallel/screening/unit_runner.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/engine/margin_search.hpp"
#include "core/engine/margin_spread.hpp"
#include "core/engine/replica_run.hpp"
#include "core/engine/simulate.hpp"
#include "parallel/schedulers/processor_time.hpp"
#include "parallel/screening/failure_order.hpp"
#include "parallel/screening/series_limit.hpp"

namespace holdfast::internal {

namespace {

std::string describe(Status status) {
  if (has(status, Status::non_finite)) return "a state became infinite or undefined; try a smaller step";
  if (has(status, Status::not_converged)) return "the solver did not converge; try more iterations";
  if (has(status, Status::capacity)) return "the device had no room for all contacts, or failed; try another engine";
  return "";
}

bool is_good(const WorldRecord& world) { return world.outcome.status == Status::ok; }

/// Puts what became of a world in its place.
void put(WorldRecord&& simulated, WorldRecord& world) {
  simulated.layout = world.layout;
  simulated.acceleration = world.acceleration;
  simulated.status_text = describe(simulated.outcome.status);
  world = std::move(simulated);
}

}  // namespace

std::optional<UnitRecord> UnitRunner::run(const WorkUnit& unit, std::size_t sharing,
                                          std::span<const std::size_t> order) {
  if (abort_) return std::nullopt;
  const double cpu_begin = processor_seconds();
  UnitRecord record;
  std::vector<std::shared_ptr<const ReadLayout>> layouts;
  for (std::size_t i = unit.layout_begin; i < unit.layout_end; ++i) {
    const std::shared_ptr<const ReadLayout> read = take(i, sharing);
    layouts.push_back(read);
    if (unit.acceleration_begin > 0) continue;
    record.layouts.push_back({i, {read, &read->layout}});
    if (settings_.screening.indicators) record.layouts.back().indicators = find_indicators(read->layout, settings_);
    record.warnings.insert(record.warnings.end(), read->warnings.begin(), read->warnings.end());
  }
  for (std::size_t i = unit.layout_begin; i < unit.layout_end; ++i)
    for (std::size_t j = unit.acceleration_begin; j < unit.acceleration_end; ++j)
      record.worlds.push_back(refused(*layouts[i - unit.layout_begin], i, j));
  const std::size_t simulated = order.empty() ? simulate_good(unit, layouts, record.worlds)
                                              : simulate_until_failure(unit, layouts, order, record.worlds);
  if (abort_) return std::nullopt;
  const double cpu_end = processor_seconds();
  const double cpu_share = (cpu_end - cpu_begin) / static_cast<double>(std::max<std::size_t>(1, simulated));
  for (WorldRecord& world : record.worlds)
    if (world.outcome.stop_reason != StopReason::not_run)
      world.cpu_seconds = cpu_share + world.outcome.counters.device_seconds;
  if (settings_.screening.replicas > 0 && !add_replicas(unit, layouts, record.worlds)) return std::nullopt;
  if (margins_ && !add_margins(record.layouts)) return std::nullopt;
  return record;
}

bool UnitRunner::add_replicas(const WorkUnit& unit, const std::vector<std::shared_ptr<const ReadLayout>>& layouts,
                              std::vector<WorldRecord>& worlds) const {
  const StageTimer timer(costs_, Stage::simulate);
  for (WorldRecord& world : worlds) {
    if (world.outcome.stop_reason == StopReason::not_run) continue;
    const double cpu_begin = processor_seconds();
    std::optional<ReplicaOutcome> replicas =
        run_replicas(engine_, layouts[world.layout - unit.layout_begin]->layout,
                     accelerations_[world.acceleration].acceleration, settings_, abort_);
    if (!replicas) return false;
    world.replicas = std::move(*replicas);
    world.replicas.cpu_seconds = processor_seconds() - cpu_begin;
  }
  return true;
}

bool UnitRunner::add_margins(std::vector<LayoutRecord>& layouts) const {
  const StageTimer timer(costs_, Stage::simulate);
  for (LayoutRecord& record : layouts) {
    if (record.layout->boxes.empty()) continue;
    const double cpu_begin = processor_seconds();
    const std::optional<LayoutMargins> margins = find_margins(engine_, *record.layout, settings_, abort_);
    if (!margins) return false;
    record.margins = *margins;
    const double cpu_end = processor_seconds();
    record.margins.cpu_seconds = cpu_end - cpu_begin;
    if (settings_.screening.replicas == 0) continue;
    const std::optional<MarginSpread> spread = find_margin_spread(engine_, *record.layout, settings_, abort_);
    if (!spread) return false;
    record.margins.spread = *spread;
    record.margins.spread.cpu_seconds = processor_seconds() - cpu_end;
  }
  return true;
}

std::shared_ptr<const ReadLayout> UnitRunner::take(std::size_t layout, std::size_t takers) const {
  const StageTimer timer(costs_, Stage::read);
  return layouts_.take(layout, takers);
}

WorldRecord UnitRunner::refused(const ReadLayout& layout, std::size_t layout_index, std::size_t acceleration) const {
  WorldRecord world;
  world.layout = layout_index;
  world.acceleration = acceleration;
  if (!layout.error.empty()) {
    world.outcome.status = Status::bad_layout;
    world.status_text = layout.error;
  } else if (!accelerations_[acceleration].error.empty()) {
    world.outcome.status = Status::bad_acceleration;
    world.status_text = accelerations_[acceleration].error;
  } else if (!plan_.series) {
    return world;
  } else if (const auto error = check_rows(layout.layout.name, layout.layout.boxes.size(),
                                           accelerations_[acceleration].acceleration, settings_)) {
    world.outcome.status = Status::too_large;
    world.status_text = error->message();
  }
  return world;
}

std::size_t UnitRunner::simulate_good(const WorkUnit& unit,
                                      const std::vector<std::shared_ptr<const ReadLayout>>& layouts,
                                      std::vector<WorldRecord>& worlds) const {
  const std::size_t acceleration_count = unit.acceleration_end - unit.acceleration_begin;
  // A batch is every layout under the same accelerations: layouts that go under different ones go in different batches.
  std::map<std::vector<std::size_t>, std::vector<std::size_t>> batches;
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    std::vector<std::size_t> accelerations;
    for (std::size_t j = 0; j < acceleration_count; ++j)
      if (is_good(worlds[i * acceleration_count + j])) accelerations.push_back(j);
    if (!accelerations.empty()) batches[accelerations].push_back(i);
  }
  std::size_t simulated = 0;
  for (const auto& [accelerations, of_layouts] : batches) {
    std::vector<const Layout*> batch_layouts;
    std::vector<const Acceleration*> batch_accelerations;
    for (const std::size_t i : of_layouts) batch_layouts.push_back(&layouts[i]->layout);
    for (const std::size_t j : accelerations)
      batch_accelerations.push_back(&accelerations_[unit.acceleration_begin + j].acceleration);
    std::vector<WorldRecord> records = simulate_batch(batch_layouts, batch_accelerations);
    simulated += records.size();
    auto next = records.begin();
    for (const std::size_t i : of_layouts) {
      for (const std::size_t j : accelerations) {
        if (next == records.end()) return simulated;
        put(std::move(*next++), worlds[i * acceleration_count + j]);
      }
    }
  }
  return simulated;
}

std::size_t UnitRunner::simulate_until_failure(const WorkUnit& unit,
                                               const std::vector<std::shared_ptr<const ReadLayout>>& layouts,
                                               std::span<const std::size_t> order,
                                               std::vector<WorldRecord>& worlds) const {
  const std::size_t acceleration_count = unit.acceleration_end - unit.acceleration_begin;
  std::vector<const std::string*> failed_by(layouts.size());  // name of the acceleration, once there is one
  std::size_t simulated = 0;
  for (const std::size_t j : order) {
    const Acceleration& acceleration = accelerations_[j].acceleration;
    std::vector<std::size_t> tried;
    std::vector<const Layout*> batch_layouts;
    for (std::size_t i = 0; i < layouts.size(); ++i) {
      WorldRecord& world = worlds[i * acceleration_count + j];
      if (!is_good(world)) continue;
      if (failed_by[i] != nullptr) {
        world.outcome.status = Status::not_needed;
        world.status_text = "the layout does not hold " + *failed_by[i];
        continue;
      }
      tried.push_back(i);
      batch_layouts.push_back(&layouts[i]->layout);
    }
    if (tried.empty()) continue;
    std::vector<WorldRecord> records = simulate_batch(batch_layouts, {&acceleration});
    simulated += records.size();
    if (records.size() < tried.size()) return simulated;
    for (std::size_t k = 0; k < tried.size(); ++k) {
      if (rejects(records[k], plan_.thresholds)) failed_by[tried[k]] = &acceleration.name;
      put(std::move(records[k]), worlds[tried[k] * acceleration_count + j]);
    }
  }
  return simulated;
}

std::vector<WorldRecord> UnitRunner::simulate_batch(const std::vector<const Layout*>& layouts,
                                                    const std::vector<const Acceleration*>& accelerations) const {
  WorldBatch batch = make_batch(layouts, accelerations, settings_);
  std::vector<std::unique_ptr<SeriesRecorder>> owners;
  std::vector<Recorder*> recorders;
  for (std::size_t i = 0; i < batch.worlds.size(); ++i) {
    RecordingPlan plan = plan_;
    plan.samples = static_cast<std::size_t>(most_samples(*batch.worlds[i].acceleration, settings_));
    owners.push_back(std::make_unique<SeriesRecorder>(plan));
    recorders.push_back(owners.back().get());
  }
  const StageTimer timer(costs_, Stage::simulate);
  std::vector<WorldRecord> records;
  if (!simulate(engine_, batch, settings_, recorders, abort_)) return records;
  for (const auto& owner : owners) records.push_back(owner->take());
  return records;
}

}  // namespace holdfast::internal
