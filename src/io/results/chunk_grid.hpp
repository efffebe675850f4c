#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/results/results_columns.hpp"
#include "io/results/results_schema.hpp"

namespace holdfast::internal {

/// Entries of every long dataset, in the order of `long_datasets`, in their stored form.
using LongEntries = std::vector<std::vector<std::byte>>;
inline LongEntries no_entries() { return LongEntries(long_datasets().size()); }

/// A full chunk of a long dataset: raw, or compressed as in the file.
struct GridChunk {
  std::size_t column = 0;   ///< index of the dataset among the long ones
  std::uint64_t index = 0;  ///< of the chunk in the run
  std::vector<std::byte> bytes;
};

/// The entries that a unit adds to the long datasets.
struct GridPiece {
  std::vector<GridChunk> chunks;    ///< those that it completes; for each dataset, by increasing index
  LongEntries rest = no_entries();  ///< its entries after the last completed chunk
};

/// Concatenates the long entries of successive worlds and divides them into chunks of n = `chunk_entries` each, on one
/// grid for the whole run: chunk i has the entries [i n, (i + 1) n). Parts can then be assembled without decompressing
/// them, wherever one part ends and the next begins.
class ChunkGrid {
 public:
  ChunkGrid() = default;

  /// Continues an interrupted run.
  /// @param counts entries of the run up to now
  /// @param tail   those of them in the incomplete chunks
  ChunkGrid(const AxisCounts& counts, LongEntries tail);

  /// Moves the long columns out of the set.
  GridPiece add(ColumnSet& columns);

 private:
  std::vector<std::uint64_t> next_chunk_ = std::vector<std::uint64_t>(long_datasets().size());
  LongEntries tail_ = no_entries();
};

/// Updates the entries of the incomplete chunks with a piece: those after the last chunk that the piece completes.
void append_rest(const GridPiece& piece, LongEntries& tail);

}  // namespace holdfast::internal
