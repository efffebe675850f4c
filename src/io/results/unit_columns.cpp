#include "io/results/unit_columns.hpp"

#include <cassert>
#include <string_view>
#include <type_traits>

#include "io/results/results_inputs.hpp"
#include "io/results/results_tables.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

namespace {

std::string_view path_of(const DatasetContent& content) { return content.path; }
std::string_view path_of(const OutcomeField& field) { return field.dataset; }

/// The row of the world, with the places of its entries: after those of the run.
WorldRow row_of(const WorldRecord& world, const RunDescription& run, const AxisCounts& end) {
  WorldRow row = world.row;
  row.box_begin = at(end, Axis::boxes);
  row.sample_begin = at(end, Axis::samples);
  row.sample_count = static_cast<std::uint32_t>(world.series.time.size());
  row.row_begin = at(end, Axis::rows);
  row.engine = run.engine;
  return row;
}

void append_world(WorldRecord& world, const RunDescription& run, AxisCounts& end, ColumnSet& columns) {
  const std::size_t box_count = world.boxes.id.size();
  const std::size_t sample_count = world.series.time.size();
  assert(world.end.end_displacement.size() == box_count && world.end.settling_displacement.size() == box_count);
  assert(world.series.displacement.size() == sample_count * box_count);

  const auto append_from = [&](const auto& from) {
    return [&](const auto& what, auto member) { columns[path_of(what)].append(from.*member); };
  };
  visit_world_row<WorldRow>(append_from(row_of(world, run, end)));
  visit_boxes(append_from(world.boxes));
  visit_ends<EndTable>(append_from(world.end));
  columns["/boxes/world"].append(std::vector<std::uint64_t>(box_count, at(end, Axis::worlds)));
  visit_world_verdict<WorldVerdict>(append_from(judge_world(world.row, world.end, by_run(run.thresholds))));
  const std::vector<BoxVerdict> boxes = judge_boxes(world.end, by_run(run.thresholds));
  visit_box_verdict<BoxVerdict>(
      [&](const OutcomeField& field, auto member) { columns[field.dataset].append(boxes, member); });
  for (const AnalysisTables* analysis : run.analyses)
    if (analysis->append_world != nullptr) analysis->append_world(columns, world, run.record_series);
  // Column by column, so that at most one of them is in memory twice.
  visit_series([&](const DatasetContent& content, auto member) {
    columns[content.path].append(world.series.*member);
    world.series.*member = std::decay_t<decltype(world.series.*member)>();  // which gives its memory back
  });

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
    for (const AnalysisTables* analysis : run.analyses)
      if (analysis->append_layout != nullptr) analysis->append_layout(columns, record);
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
