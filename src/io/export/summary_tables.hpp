#pragma once

#include "io/results/hdf5_file.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

/// Writes /summary/worlds and /summary/boxes of `results` into `file`. For src/io only; throws `h5::Failure`.
void write_summary_tables(const h5::File& file, ResultsReader& results, const Thresholds& thresholds);

}  // namespace holdfast::internal
