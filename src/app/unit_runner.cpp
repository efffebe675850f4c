#include "app/unit_runner.hpp"

#include <algorithm>
#include <memory>

#include "core/simulate.hpp"
#include "parallel/processor_time.hpp"

namespace holdfast {

namespace {

std::string describe(Status status) {
  if (has(status, Status::non_finite)) return "a state became infinite or undefined; try a smaller step";
  if (has(status, Status::not_converged)) return "the solver did not converge; try more iterations";
  if (has(status, Status::capacity)) return "the device had no room for all contacts, or failed; try another engine";
  return "";
}

}  // namespace

std::optional<UnitRecord> UnitRunner::run(const WorkUnit& unit, std::size_t sharing) {
  if (abort_) return std::nullopt;
  const double cpu_begin = processor_seconds();
  UnitRecord record;
  std::vector<std::shared_ptr<const ReadLayout>> layouts;
  std::vector<Layout> usable_layouts;
  for (std::size_t i = unit.layout_begin; i < unit.layout_end; ++i) {
    const ReadLayout& read = *layouts.emplace_back(layouts_.take(i, sharing));
    if (read.error.empty()) usable_layouts.push_back(read.layout);
    if (unit.motion_begin > 0) continue;
    record.layouts.push_back({i, read.layout});
    record.warnings.insert(record.warnings.end(), read.warnings.begin(), read.warnings.end());
  }
  std::vector<const Motion*> usable_motions;
  for (std::size_t i = unit.motion_begin; i < unit.motion_end; ++i)
    if (motions_[i].error.empty()) usable_motions.push_back(&motions_[i].motion);

  WorldBatch batch = make_batch(usable_layouts, usable_motions, settings_);
  std::vector<std::unique_ptr<SeriesRecorder>> owners;
  std::vector<Recorder*> recorders;
  for (std::size_t i = 0; i < batch.worlds.size(); ++i) {
    owners.push_back(std::make_unique<SeriesRecorder>(plan_));
    recorders.push_back(owners.back().get());
  }
  if (!batch.worlds.empty()) {
    const StageTimer timer(costs_, Stage::simulate);
    if (!simulate(engine_, batch, settings_, recorders, abort_)) return std::nullopt;
  }

  std::size_t next = 0;
  for (std::size_t i = unit.layout_begin; i < unit.layout_end; ++i) {
    for (std::size_t j = unit.motion_begin; j < unit.motion_end; ++j) {
      const ReadLayout& layout = *layouts[i - unit.layout_begin];
      WorldRecord world;
      if (!layout.error.empty()) {
        world.outcome.status = Status::bad_layout;
        world.status_text = layout.error;
      } else if (!motions_[j].error.empty()) {
        world.outcome.status = Status::bad_acceleration;
        world.status_text = motions_[j].error;
      } else {
        world = owners[next++]->take();
        world.status_text = describe(world.outcome.status);
      }
      world.layout = i;
      world.acceleration = j;
      record.worlds.push_back(std::move(world));
    }
  }
  const double cpu_share = (processor_seconds() - cpu_begin) / static_cast<double>(std::max<std::size_t>(1, next));
  for (WorldRecord& world : record.worlds)
    if (world.outcome.stop_reason != StopReason::not_run)
      world.cpu_seconds = cpu_share + world.outcome.counters.device_seconds;
  return record;
}

}  // namespace holdfast
