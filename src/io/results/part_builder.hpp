#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "io/results/chunk_grid.hpp"
#include "io/results/results_part.hpp"
#include "io/results/results_writer.hpp"

namespace holdfast::internal {

/// The open part. It is built in memory, where HDF5 cannot fail because of a full disk, and is written at once.
/// For src/io only; throws `h5::Failure`.
class PartBuilder {
 public:
  /// @param begin entries of the run before this part, per axis
  /// @param tail  those of them in the incomplete chunks, which the part repeats
  PartBuilder(const std::string& path, const RunDescription& run, const AxisCounts& begin, LongEntries tail);

  void add(UnitPiece&& unit);

  std::size_t world_count() const { return columns_.columns()[dataset_index("/worlds/layout")].count(); }
  /// Bytes of the full chunks up to now.
  std::size_t bytes() const { return bytes_; }
  std::chrono::steady_clock::time_point opened() const { return opened_; }

  /// Writes the part to disk. Afterwards only `end` and `tail` may be called.
  void close();

  /// Entries of the run up to the end of this part, and those of them in the incomplete chunks.
  const AxisCounts& end() const { return end_; }
  const LongEntries& tail() const { return tail_; }

 private:
  void write_tail();

  std::string path_;
  h5::File file_;
  RunTables analyses_;  ///< of the run
  AxisCounts begin_;    ///< for long datasets, at the start of a chunk
  AxisCounts end_;
  ColumnSet columns_;                           ///< the short datasets
  std::map<std::size_t, h5::Dataset> chunked_;  ///< the long datasets of the run, by their index among all
  LongEntries tail_;
  std::size_t bytes_ = 0;
  std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
};

}  // namespace holdfast::internal
