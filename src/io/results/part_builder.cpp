#include "io/results/part_builder.hpp"

#include <cassert>
#include <utility>

#include "io/export/table_writer.hpp"
#include "io/results/chunk_codec.hpp"
#include "io/results/durable_file.hpp"
#include "io/results/results_inputs.hpp"

namespace holdfast::internal {

PartBuilder::PartBuilder(const std::string& path, const RunDescription& run, const AxisCounts& begin, LongEntries tail)
    : path_(path),
      file_(h5::File::create_in_memory(path)),
      analyses_(run.analyses),
      begin_(begin),
      end_(begin),
      tail_(std::move(tail)) {
  for (const Axis axis : kLongAxes) at(begin_, axis) = chunk_begin(axis, at(begin, axis));
  write_run(file_, run);
  if (at(begin, Axis::worlds) == 0) write_layout_hashes(file_, run.layout_hashes);
  write_range_begin(file_, begin_);
  h5::write_attribute(file_, "/", "complete", std::uint64_t{0});
  append_accelerations(columns_, run.accelerations);
  for (std::size_t column = 0; column < long_datasets().size(); ++column) {
    const DatasetSpec& spec = schema()[long_datasets()[column]];
    if (includes(analyses_, spec)) chunked_.emplace(column, h5::Dataset::create(file_, spec, 0, 1));
  }
}

void PartBuilder::add(UnitPiece&& unit) {
  for (const GridChunk& chunk : unit.piece.chunks) {
    h5::Dataset& dataset = chunked_.at(chunk.column);
    const std::uint64_t index = chunk.index - at(begin_, dataset.spec().axis) / dataset.chunk_entries();
    dataset.extend((index + 1) * dataset.chunk_entries());
    dataset.write_chunk(index, chunk.bytes);
    bytes_ += chunk.bytes.size();
  }
  append_rest(unit.piece, tail_);
  columns_.append(unit.columns);
  end_ = unit.end;
}

void PartBuilder::write_tail() {
  for (auto& [column, dataset] : chunked_) {
    const Axis axis = dataset.spec().axis;
    const std::uint64_t length = at(end_, axis) - at(begin_, axis);
    dataset.extend(length);
    assert(tail_[column].size() == length % dataset.chunk_entries() * dataset.entry_bytes());
    if (tail_[column].empty()) continue;
    const std::size_t chunk_bytes = dataset.chunk_entries() * dataset.entry_bytes();
    dataset.write_chunk(length / dataset.chunk_entries(),
                        compress_padded_chunk(tail_[column], dataset.number_bytes(), chunk_bytes));
  }
}

void PartBuilder::close() {
  write_tail();
  chunked_.clear();
  for (const Column& column : columns_.columns())
    if (!is_long(column.spec()) && includes(analyses_, column.spec())) write_column(file_, column);
  const std::vector<std::byte> image = file_.image();
  file_.close();
  write_durably(path_, image);
}

}  // namespace holdfast::internal
