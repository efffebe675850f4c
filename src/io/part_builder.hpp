#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "io/results_columns.hpp"
#include "io/results_part.hpp"
#include "io/results_writer.hpp"

namespace holdfast {

/// The open part. It is built in memory, where HDF5 cannot fail for want of disk, and reaches the disk in one go.
/// For src/io only; throws `h5::Failure`.
class PartBuilder {
 public:
  /// @param begin entries of the run before this part, an axis each
  PartBuilder(const std::string& path, const RunDescription& run, const AxisCounts& begin);

  void add(PackedUnit&& unit);

  std::size_t world_count() const { return columns_.columns()[dataset_index("/worlds/layout")].count(); }
  /// Bytes of compressed series so far.
  std::size_t bytes() const { return bytes_; }
  std::chrono::steady_clock::time_point opened() const { return opened_; }

  /// Writes the part to disk. Afterwards only `end` may be called.
  void close();

  /// Entries of the run up to the end of this part.
  const AxisCounts& end() const { return end_; }

 private:
  void append_world(const WorldRecord& world, std::uint64_t sample_count);
  void write_tail();

  std::string path_;
  std::string engine_;
  h5::File file_;
  AxisCounts begin_;  ///< those of the series at a chunk's start
  AxisCounts end_;
  ColumnSet columns_;
  std::vector<h5::Dataset> series_;
  std::array<std::vector<std::byte>, kSeriesColumns> tail_;  ///< raw, after the last full chunk
  std::size_t bytes_ = 0;
  std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
};

}  // namespace holdfast
