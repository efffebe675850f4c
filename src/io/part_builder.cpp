#include "io/part_builder.hpp"

#include <cassert>
#include <utility>

#include "io/chunk_codec.hpp"
#include "io/durable_file.hpp"
#include "io/results_columns.hpp"
#include "io/results_inputs.hpp"
#include "io/table_writer.hpp"

namespace holdfast {

PartBuilder::PartBuilder(const std::string& path, const RunDescription& run, const AxisCounts& begin)
    : path_(path), engine_(run.engine), file_(h5::File::create_in_memory(path)), begin_(begin), end_(begin) {
  for (const Axis axis : {Axis::samples, Axis::rows}) at(begin_, axis) = chunk_begin(at(begin, axis));
  write_run(file_, run);
  write_range_begin(file_, begin_);
  h5::write_attribute(file_, "/", "complete", std::uint64_t{0});
  append_accelerations(columns_, run.accelerations);
  for (std::size_t column = 0; column < kSeriesColumns; ++column)
    series_.push_back(h5::Dataset::create(file_, kSchema[first_series_dataset() + column], 0, 1));
}

void PartBuilder::add(PackedUnit&& unit) {
  for (const LayoutRecord& record : unit.record.layouts) {
    assert(record.index == at(end_, Axis::layouts));
    append_layout(columns_, record.layout);
    at(end_, Axis::layouts) += 1;
    at(end_, Axis::layout_boxes) += record.layout.boxes.size();
  }
  for (const SeriesChunk& chunk : unit.series.chunks) {
    h5::Dataset& dataset = series_[chunk.column];
    const std::uint64_t index = chunk.index - at(begin_, dataset.spec().axis) / kChunkEntries;
    dataset.extend((index + 1) * kChunkEntries);
    dataset.write_chunk(index, chunk.bytes);
    bytes_ += chunk.bytes.size();
  }
  for (std::size_t i = 0; i < unit.record.worlds.size(); ++i)
    append_world(unit.record.worlds[i], unit.series.sample_counts[i]);
  assert(at(end_, Axis::samples) == unit.series.sample_end && at(end_, Axis::rows) == unit.series.row_end);
  tail_ = std::move(unit.series.tail);
}

void PartBuilder::append_world(const WorldRecord& world, std::uint64_t sample_count) {
  const std::uint64_t local_world = at(end_, Axis::worlds) - at(begin_, Axis::worlds);
  const auto box_count = static_cast<std::uint32_t>(world.boxes.id.size());
  assert(world.end.displacement.size() == box_count && world.end.settling_displacement.size() == box_count);
  WorldRow row;
  row.layout = world.layout;
  row.acceleration = world.acceleration;
  row.status = world.outcome.status;
  row.status_text = world.status_text;
  row.stop_reason = world.outcome.stop_reason;
  row.box_begin = at(end_, Axis::boxes) - at(begin_, Axis::boxes);
  row.box_count = box_count;
  row.sample_begin = at(end_, Axis::samples) - at(begin_, Axis::samples);
  row.sample_count = static_cast<std::uint32_t>(sample_count);
  row.row_begin = at(end_, Axis::rows) - at(begin_, Axis::rows);
  row.end_time = world.outcome.end_time;
  row.steps = world.outcome.counters.steps;
  row.steps_skipped = world.outcome.counters.steps_skipped;
  row.solve_iterations = world.outcome.counters.solve_iterations;
  row.max_residual = world.outcome.counters.max_residual;
  row.max_penetration = world.outcome.counters.max_penetration;
  row.peak_total_kinetic_energy = world.peak_total_kinetic_energy;
  row.cpu_seconds = world.cpu_seconds;
  row.state_hash = world.state_hash;
  row.engine = engine_;

  const auto append = [&](std::string_view path, const auto& values) { columns_[path].append(values); };
  visit_world(append, row);
  visit_boxes(append, world.boxes);
  visit_ends(append, world.end);
  columns_["/boxes/world"].append(std::vector<std::uint64_t>(box_count, local_world));

  at(end_, Axis::worlds) += 1;
  at(end_, Axis::boxes) += box_count;
  at(end_, Axis::samples) += sample_count;
  at(end_, Axis::rows) += sample_count * box_count;
}

void PartBuilder::write_tail() {
  for (std::size_t column = 0; column < kSeriesColumns; ++column) {
    h5::Dataset& dataset = series_[column];
    const Axis axis = dataset.spec().axis;
    const std::uint64_t length = at(end_, axis) - at(begin_, axis);
    dataset.extend(length);
    std::vector<std::byte>& tail = tail_[column];
    assert(tail.size() == length % kChunkEntries * dataset.entry_bytes());
    if (tail.empty()) continue;
    tail.resize(kChunkEntries * dataset.entry_bytes());
    dataset.write_chunk(length / kChunkEntries, compress_chunk(tail, dataset.number_bytes()));
  }
}

void PartBuilder::close() {
  write_tail();
  series_.clear();
  for (const Column& column : columns_.columns())
    if (column.spec().origin == Origin::recorded && !is_series(column.spec())) write_column(file_, column);
  const std::vector<std::byte> image = file_.image();
  file_.close();
  write_durably(path_, image);
}

}  // namespace holdfast
