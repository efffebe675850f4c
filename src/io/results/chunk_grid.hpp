#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/results/results_columns.hpp"
#include "io/results/results_schema.hpp"

namespace holdfast::internal {

/// Entries of every long dataset, in the order of `long_datasets`, as they are stored.
using LongEntries = std::array<std::vector<std::byte>, kLongDatasets>;

/// A full chunk of a long dataset: raw, or compressed as the file holds it.
struct GridChunk {
  std::size_t column = 0;   ///< place of the dataset among the long ones
  std::uint64_t index = 0;  ///< of the chunk in the run
  std::vector<std::byte> bytes;
};

/// What a unit adds to the long datasets.
struct GridPiece {
  std::vector<GridChunk> chunks;  ///< those that it completes; of a dataset, by rising index
  LongEntries rest;               ///< its entries after the last of them, or all
};

/// Lays the long entries of successive worlds end to end and cuts them into chunks of n = `chunk_entries` each, on one
/// grid for the whole run: chunk i holds entries [i n, (i + 1) n). Parts can then be put
/// together without unpacking, wherever they were cut.
class ChunkGrid {
 public:
  ChunkGrid() = default;

  /// Goes on where an earlier run was cut.
  /// @param counts entries of the run so far
  /// @param tail those of the incomplete chunks
  ChunkGrid(const AxisCounts& counts, LongEntries tail);

  /// Takes the long columns out of the set.
  GridPiece add(ColumnSet& columns);

 private:
  std::array<std::uint64_t, kLongDatasets> next_chunk_{};
  LongEntries tail_;
};

/// Adds a piece to the entries of the incomplete chunks: what follows the last chunk that the piece completes.
void append_rest(const GridPiece& piece, LongEntries& tail);

}  // namespace holdfast::internal
