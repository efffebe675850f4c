#include "io/export/table_writer.hpp"

#include <algorithm>

#include "io/results/chunk_codec.hpp"

namespace holdfast::internal {

TableWriter::TableWriter(const h5::File& file, const DatasetSpec& spec, std::uint64_t length, std::size_t text_size)
    : dataset_(h5::Dataset::create(file, spec, length, text_size)) {}

void TableWriter::append(std::span<const std::byte> entries) {
  const std::size_t chunk_bytes = dataset_.chunk_entries() * dataset_.entry_bytes();
  while (!entries.empty()) {
    const auto head = entries.first(std::min(chunk_bytes - pending_.size(), entries.size()));
    pending_.insert(pending_.end(), head.begin(), head.end());
    entries = entries.subspan(head.size());
    if (pending_.size() == chunk_bytes && !dataset_.whole()) write_pending();
  }
}

void TableWriter::finish() {
  assert(written_ * dataset_.chunk_entries() + pending_.size() / dataset_.entry_bytes() >= dataset_.length());
  if (pending_.empty()) return;
  if (dataset_.whole()) return dataset_.write_whole(pending_);
  const std::size_t chunk_bytes = dataset_.chunk_entries() * dataset_.entry_bytes();
  dataset_.write_chunk(written_++, compress_padded_chunk(pending_, dataset_.number_bytes(), chunk_bytes));
  pending_.clear();
}

void TableWriter::write_pending() {
  dataset_.write_chunk(written_++, compress_chunk(pending_, dataset_.number_bytes()));
  pending_.clear();
}

void write_column(const h5::File& file, const Column& column) {
  TableWriter writer(file, column.spec(), column.count(), column.text_size());
  writer.append(column.stored(column.text_size()));
  writer.finish();
}

}  // namespace holdfast::internal
