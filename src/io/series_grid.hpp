#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/world_record.hpp"

namespace holdfast {

/// Number of datasets under /series.
inline constexpr std::size_t kSeriesColumns = 10;

/// One chunk of a series dataset: raw, or compressed as the file holds it.
struct SeriesChunk {
  std::size_t column = 0;   ///< place of the dataset among those of /series in the schema
  std::uint64_t index = 0;  ///< of the chunk in the run
  std::vector<std::byte> bytes;
};

/// What a unit adds to the series: the chunks it completes, and what is left over after them.
struct SeriesPiece {
  std::uint64_t sample_begin = 0;            ///< first sample of the unit in the run
  std::uint64_t row_begin = 0;               ///< first row of the unit in the run
  std::uint64_t sample_end = 0;              ///< one past the last
  std::uint64_t row_end = 0;                 ///< one past the last
  std::vector<std::uint64_t> sample_counts;  ///< of each world of the unit
  std::vector<SeriesChunk> chunks;
  /// Raw copy of the incomplete chunk after the unit, by column; may begin with rows of earlier units.
  std::array<std::vector<std::byte>, kSeriesColumns> tail;
};

/// Lays the series of successive worlds end to end and cuts them into chunks of `kChunkEntries` entries, on one
/// grid for the whole run: chunk i holds entries [i kChunkEntries, (i + 1) kChunkEntries). Parts can then be put
/// together without unpacking, wherever they were cut.
class SeriesGrid {
 public:
  SeriesGrid() = default;

  /// Goes on where an earlier run was cut.
  /// @param tail entries of the incomplete chunk, by column
  SeriesGrid(std::uint64_t sample_count, std::uint64_t row_count,
             std::array<std::vector<std::byte>, kSeriesColumns> tail);

  /// Takes the series out of the worlds.
  SeriesPiece add(std::vector<WorldRecord>& worlds);

 private:
  std::uint64_t sample_count_ = 0;
  std::uint64_t row_count_ = 0;
  std::array<std::vector<std::byte>, kSeriesColumns> tail_;
};

}  // namespace holdfast
