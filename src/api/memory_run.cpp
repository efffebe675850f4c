#include "api/memory_run.hpp"

#include <utility>

#include "api/convert.hpp"

namespace holdfast::internal {

std::unique_ptr<SinkUnit> MemorySink::place(UnitRecord& unit) {
  for (WorldRecord& record : unit.worlds) {
    holdfast::WorldOutcome& world = worlds_[record.layout * acceleration_count_ + record.acceleration];
    fill_world(record, thresholds_, keep_boxes_, world);
    move_series(std::move(record.series), world.series);
  }
  return std::make_unique<DoneUnit>();
}

}  // namespace holdfast::internal
