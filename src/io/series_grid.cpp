#include "io/series_grid.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "io/results_columns.hpp"

namespace holdfast {

namespace {

const DatasetSpec& series_spec(std::size_t column) { return kSchema[first_series_dataset() + column]; }

}  // namespace

SeriesGrid::SeriesGrid(std::uint64_t sample_count, std::uint64_t row_count,
                       std::array<std::vector<std::byte>, kSeriesColumns> tail)
    : sample_count_(sample_count), row_count_(row_count), tail_(std::move(tail)) {}

SeriesPiece SeriesGrid::add(std::vector<WorldRecord>& worlds) {
  SeriesPiece piece;
  piece.sample_begin = sample_count_;
  piece.row_begin = row_count_;
  std::array<std::uint64_t, kSeriesColumns> next_chunk{};
  for (std::size_t column = 0; column < kSeriesColumns; ++column) {
    const bool of_samples = series_spec(column).axis == Axis::samples;
    next_chunk[column] = (of_samples ? sample_count_ : row_count_) / kChunkEntries;
  }
  for (WorldRecord& world : worlds) {
    piece.sample_counts.push_back(world.series.time.size());
    sample_count_ += world.series.time.size();
    row_count_ += world.series.displacement.size();
    assert(world.series.displacement.size() == world.series.time.size() * world.boxes.id.size());
    std::size_t column = 0;
    visit_series(
        [&](std::string_view path, const auto& values) {
          assert(series_spec(column).path == path);
          static_cast<void>(path);
          const std::size_t chunk_bytes = kChunkEntries * sizeof(values[0]);
          std::span<const std::byte> rest = std::as_bytes(std::span(values));
          std::vector<std::byte>& tail = tail_[column];
          while (!rest.empty()) {
            const auto head = rest.first(std::min(chunk_bytes - tail.size(), rest.size()));
            tail.insert(tail.end(), head.begin(), head.end());
            rest = rest.subspan(head.size());
            if (tail.size() < chunk_bytes) continue;
            piece.chunks.push_back({column, next_chunk[column]++, std::exchange(tail, {})});
          }
          ++column;
        },
        world.series);
    world.series = {};
  }
  piece.sample_end = sample_count_;
  piece.row_end = row_count_;
  piece.tail = tail_;
  return piece;
}

}  // namespace holdfast
