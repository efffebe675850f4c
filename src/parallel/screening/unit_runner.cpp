#include "parallel/screening/unit_runner.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/engine/engine_support.hpp"
#include "parallel/schedulers/processor_time.hpp"
#include "parallel/screening/failure_order.hpp"
#include "parallel/screening/world_limits.hpp"

namespace holdfast::internal {

namespace {

std::string describe(Status status) {
  if (has(status, Status::non_finite)) return "a state became infinite or undefined; try a smaller step";
  if (has(status, Status::not_converged)) return "the solver did not converge; try more iterations";
  if (has(status, Status::capacity)) return "the device had no room for all contacts, or failed; try another engine";
  return "";
}

bool is_good(const WorldRecord& world) { return world.row.status == Status::ok; }

/// Puts what became of a world in its place.
void put(WorldRecord&& simulated, WorldRecord& world) {
  simulated.row.layout = world.row.layout;
  simulated.row.acceleration = world.row.acceleration;
  simulated.row.message = describe(simulated.row.status);
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
    if (world.row.stop_reason != StopReason::not_run) world.row.cpu_seconds += cpu_share;
  if (!analyse(unit, layouts, record)) return std::nullopt;
  return record;
}

bool UnitRunner::analyse(const WorkUnit& unit, const std::vector<std::shared_ptr<const ReadLayout>>& layouts,
                         UnitRecord& record) const {
  if (analyses_.empty()) return true;  // reading the clock takes microseconds
  const StageTimer timer(costs_, Stage::simulate);
  const AnalysisInputs inputs{engine_, settings_, abort_, processor_seconds};
  for (const AnalysisMethod* analysis : analyses_) {
    if (analysis->of_layout != nullptr)
      for (LayoutRecord& layout : record.layouts)
        if (!analysis->of_layout(inputs, layout)) return false;
    if (analysis->of_world == nullptr) continue;
    for (WorldRecord& world : record.worlds)
      if (world.row.stop_reason != StopReason::not_run &&
          !analysis->of_world(inputs, layouts[world.row.layout - unit.layout_begin]->layout,
                              accelerations_[world.row.acceleration].acceleration, world))
        return false;
  }
  return true;
}

std::shared_ptr<const ReadLayout> UnitRunner::take(std::size_t layout, std::size_t takers) const {
  const StageTimer timer(costs_, Stage::read);
  const std::shared_ptr<const ReadLayout> read = layouts_.take(layout, takers);
  if (engine_.traits().has_mats || !read->error.empty()) return read;
  ReadLayout own = *read;
  if (!refuse_unsupported(own, engine_, layouts_.label(layout))) return read;
  return std::make_shared<const ReadLayout>(std::move(own));
}

WorldRecord UnitRunner::refused(const ReadLayout& layout, std::size_t layout_index, std::size_t acceleration) const {
  WorldRecord world;
  world.row.layout = layout_index;
  world.row.acceleration = acceleration;
  if (!layout.error.empty()) {
    world.row.status = Status::bad_layout;
    world.row.message = layout.error;
  } else if (!accelerations_[acceleration].error.empty()) {
    world.row.status = Status::bad_acceleration;
    world.row.message = accelerations_[acceleration].error;
  } else if (!plan_.series) {
    return world;
  } else if (const auto error = check_rows(layout.layout.name, layout.layout.boxes.size(),
                                           accelerations_[acceleration].acceleration, settings_)) {
    world.row.status = Status::too_large;
    world.row.message = error->message();
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
  std::optional<LoadSimulation> load;
  if (layouts.size() == 1) load.emplace(engine_, layouts.front()->layout, settings_);
  std::size_t simulated = 0;
  for (const std::size_t j : order) {
    const Acceleration& acceleration = accelerations_[j].acceleration;
    std::vector<std::size_t> tried;
    std::vector<const Layout*> batch_layouts;
    for (std::size_t i = 0; i < layouts.size(); ++i) {
      WorldRecord& world = worlds[i * acceleration_count + j];
      if (!is_good(world)) continue;
      if (failed_by[i] != nullptr) {
        world.row.status = Status::not_needed;
        world.row.message = "the layout does not hold " + *failed_by[i];
        continue;
      }
      tried.push_back(i);
      batch_layouts.push_back(&layouts[i]->layout);
    }
    if (tried.empty()) continue;
    std::vector<WorldRecord> records =
        load ? simulate_next(*load, acceleration) : simulate_batch(batch_layouts, {&acceleration});
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
  for (const World& world : batch.worlds) {
    owners.push_back(std::make_unique<SeriesRecorder>(plan_of(*world.acceleration)));
    recorders.push_back(owners.back().get());
  }
  const StageTimer timer(costs_, Stage::simulate);
  std::vector<WorldRecord> records;
  if (!simulate(engine_, batch, settings_, recorders, abort_)) return records;
  for (const auto& owner : owners) records.push_back(owner->take());
  return records;
}

std::vector<WorldRecord> UnitRunner::simulate_next(LoadSimulation& load, const Acceleration& acceleration) const {
  SeriesRecorder recorder(plan_of(acceleration));
  const StageTimer timer(costs_, Stage::simulate);
  std::vector<WorldRecord> records;
  if (load.run(acceleration, recorder, abort_)) records.push_back(recorder.take());
  return records;
}

RecordingPlan UnitRunner::plan_of(const Acceleration& acceleration) const {
  RecordingPlan plan = plan_for(plan_, acceleration);
  plan.samples = static_cast<std::size_t>(most_samples(acceleration, settings_));
  return plan;
}

}  // namespace holdfast::internal
