#include "io/results/unit_columns.hpp"

#include <cassert>
#include <type_traits>

#include "io/results/results_inputs.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

/// The row of the world; its entries of the other axes begin after those of the run.
WorldRow row_of(const WorldRecord& world, const RunDescription& run, const AxisCounts& end) {
  WorldRow row;
  row.layout = world.layout;
  row.acceleration = world.acceleration;
  row.status = world.outcome.status;
  row.status_text = world.status_text;
  row.stop_reason = world.outcome.stop_reason;
  row.box_begin = at(end, Axis::boxes);
  row.box_count = static_cast<std::uint32_t>(world.boxes.id.size());
  row.sample_begin = at(end, Axis::samples);
  row.sample_count = static_cast<std::uint32_t>(world.series.time.size());
  row.row_begin = at(end, Axis::rows);
  row.end_time = world.outcome.end_time;
  row.steps = world.outcome.counters.steps;
  row.steps_skipped = world.outcome.counters.steps_skipped;
  row.solve_iterations = world.outcome.counters.solve_iterations;
  row.max_residual = world.outcome.counters.max_residual;
  row.residual_scale = world.outcome.counters.residual_scale;
  row.max_penetration = world.outcome.counters.max_penetration;
  row.peak_total_kinetic_energy = world.peak_total_kinetic_energy;
  row.cpu_seconds = world.cpu_seconds;
  row.state_hash = world.state_hash;
  row.engine = run.engine;
  return row;
}

void append_world(WorldRecord& world, const RunDescription& run, AxisCounts& end, ColumnSet& columns) {
  const std::size_t box_count = world.boxes.id.size();
  const std::size_t sample_count = world.series.time.size();
  assert(world.end.displacement.size() == box_count && world.end.settling_displacement.size() == box_count);
  assert(world.series.displacement.size() == sample_count * box_count);

  const auto append = [&](std::string_view path, const auto& values) { columns[path].append(values); };
  const WorldRow row = row_of(world, run, end);
  visit_world(append, row);
  if (includes(run.analyses, Analysis::wall_forces))
    visit_walls([&](std::string_view path, auto member) { append(path, world.walls.*member); });
  visit_boxes(append, world.boxes);
  visit_ends(append, world.end);
  columns["/boxes/world"].append(std::vector<std::uint64_t>(box_count, at(end, Axis::worlds)));
  WorldSummary worlds;
  BoxSummary boxes;
  append_summary(world, run.thresholds, worlds, boxes);
  visit_world_summary(append, worlds);
  visit_box_summary(append, boxes);
  if (includes(run.analyses, Analysis::replicas)) {
    assert(world.replicas.box_share.size() == box_count);
    visit_replicas([&](std::string_view path, auto member) { append(path, world.replicas.*member); });
    append("/replicas/box_share", world.replicas.box_share);
  }
  if (includes(run.analyses, Analysis::damage)) {
    assert(world.damage.boxes.beyond.size() == box_count);
    append("/damage/boxes_beyond", world.damage.boxes_beyond);
    visit_box_damage(append, world.damage.boxes);
  }
  // Column by column, so that at most one of them is in memory twice.
  visit_series(
      [&](std::string_view path, auto& values) {
        columns[path].append(values);
        values = std::decay_t<decltype(values)>();
      },
      world.series);

  at(end, Axis::worlds) += 1;
  at(end, Axis::boxes) += box_count;
  at(end, Axis::samples) += sample_count;
  at(end, Axis::rows) += sample_count * box_count;
}

}  // namespace

ColumnSet columns_of(UnitRecord& unit, const RunDescription& run, AxisCounts& end) {
  ColumnSet columns;
  for (const LayoutRecord& record : unit.layouts) {
    assert(record.index == at(end, Axis::layouts));
    append_layout(columns, *record.layout, at(end, Axis::layout_boxes));
    if (includes(run.analyses, Analysis::margins))
      visit_margins([&](std::string_view path, auto member) { columns[path].append(record.margins.*member); });
    if (includes(run.analyses, Analysis::margin_spread))
      visit_margin_spread(
          [&](std::string_view path, auto member) { columns[path].append(record.margins.spread.*member); });
    if (includes(run.analyses, Analysis::indicators)) {
      visit_indicators([&](std::string_view path, auto member) { columns[path].append(record.indicators.*member); });
      visit_box_indicators([&](std::string_view path, const auto& values) { columns[path].append(values); },
                           record.indicators);
    }
    at(end, Axis::layouts) += 1;
    at(end, Axis::layout_boxes) += record.layout->boxes.size();
  }
  for (WorldRecord& world : unit.worlds) {
    if (!run.record_series) world.series = {};
    append_world(world, run, end, columns);
  }
  return columns;
}

}  // namespace holdfast::internal
