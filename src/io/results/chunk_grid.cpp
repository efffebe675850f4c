#include "io/results/chunk_grid.hpp"

#include <span>
#include <utility>

namespace holdfast::internal {

namespace {

const DatasetSpec& long_spec(std::size_t column) { return schema()[long_datasets()[column]]; }

}  // namespace

ChunkGrid::ChunkGrid(const AxisCounts& counts, LongEntries tail) : tail_(std::move(tail)) {
  for (std::size_t column = 0; column < long_datasets().size(); ++column)
    next_chunk_[column] = at(counts, long_spec(column).axis) / chunk_entries(long_spec(column).axis);
}

GridPiece ChunkGrid::add(ColumnSet& columns) {
  GridPiece piece;
  for (std::size_t column = 0; column < long_datasets().size(); ++column) {
    const DatasetSpec& spec = long_spec(column);
    const std::size_t chunk_bytes = chunk_entries(spec.axis) * spec.width * size_of(spec.type);
    const std::vector<std::byte> bytes = columns[spec.path].take();
    std::span<const std::byte> left = bytes;
    std::vector<std::byte>& tail = tail_[column];
    while (tail.size() + left.size() >= chunk_bytes) {
      const auto head = left.first(chunk_bytes - tail.size());
      tail.insert(tail.end(), head.begin(), head.end());
      piece.chunks.push_back({column, next_chunk_[column]++, std::exchange(tail, {})});
      left = left.subspan(head.size());
    }
    tail.insert(tail.end(), left.begin(), left.end());
    piece.rest[column].assign(left.begin(), left.end());
  }
  return piece;
}

void append_rest(const GridPiece& piece, LongEntries& tail) {
  for (const GridChunk& chunk : piece.chunks) tail[chunk.column].clear();
  for (std::size_t column = 0; column < long_datasets().size(); ++column) {
    const std::vector<std::byte>& rest = piece.rest[column];
    tail[column].insert(tail[column].end(), rest.begin(), rest.end());
  }
}

}  // namespace holdfast::internal
