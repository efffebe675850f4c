#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_columns.hpp"

namespace holdfast::internal {

/// Writes a dataset of known length sequentially, and compresses it chunk by chunk. For src/io only; throws
/// `h5::Failure`.
class TableWriter {
 public:
  TableWriter(const h5::File& file, const DatasetSpec& spec, std::uint64_t length, std::size_t text_size = 1);

  /// Adds entries in their stored form.
  void append(std::span<const std::byte> entries);

  /// Writes the last chunk; the dataset must be full.
  void finish();

 private:
  void write_pending();

  h5::Dataset dataset_;
  std::uint64_t written_ = 0;       ///< chunks
  std::vector<std::byte> pending_;  ///< entries of the incomplete chunk
};

/// Writes a whole column as a new dataset.
void write_column(const h5::File& file, const Column& column);

}  // namespace holdfast::internal
