#include "api/memory_run.hpp"

#include <utility>

#include "api/convert.hpp"

namespace holdfast::internal {

void WorldTaker::take(WorldRecord&& record, holdfast::WorldOutcome& world) const {
  fill_world(record, thresholds_, keep_boxes_, world);
  world.numbers = numbers_of(record.found);
  move_series(std::move(record.series), world.series);
}

std::unique_ptr<SinkUnit> MemorySink::place(UnitRecord& unit) {
  for (WorldRecord& record : unit.worlds)
    taker_.take(std::move(record), worlds_[record.row.layout * acceleration_count_ + record.row.acceleration]);
  return std::make_unique<DoneUnit>();
}

}  // namespace holdfast::internal
