#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_columns.hpp"
#include "io/results/run_description.hpp"

/// The parts of the file that are not results. For src/io only; throws `h5::Failure`.
namespace holdfast::internal {

/// Root attributes (all but `complete`), /inputs/config, /inputs/settings and the thresholds of /summary.
void write_run(const h5::File& file, const RunDescription& run);

/// What `write_run` wrote. Not in the file, and empty or as by default: names and hashes of layouts, and whether series
/// are recorded, which `fingerprint` has.
RunDescription read_run(const h5::File& file);

/// The texts of all settings, by `Section/Key`.
std::vector<std::pair<std::string, std::string>> read_settings(const h5::File& file);

/// A whole column of texts.
std::vector<std::string> read_texts(const h5::File& file, std::string_view path);

/// The analyses of which the file has datasets.
RunTables tables_in(const h5::File& file);

/// /inputs/layout_hashes, only in the first part of a run: hashes of all its layouts when it began. Layouts that the
/// run has reached are also in /inputs/layouts.
void write_layout_hashes(const h5::File& file, const std::vector<std::string>& hashes);
std::vector<std::string> read_layout_hashes(const h5::File& file);

/// Thresholds and their units as attributes of /summary.
void write_thresholds(const h5::File& file, const Thresholds& thresholds);
Thresholds read_thresholds(const h5::File& file);

/// Adds all accelerations to /inputs/accelerations.
void append_accelerations(ColumnSet& columns, const std::vector<Acceleration>& accelerations);

/// Adds a layout to /inputs/layouts.
/// @param box_begin index of its first box in the run
void append_layout(ColumnSet& columns, const Layout& layout, std::uint64_t box_begin);

}  // namespace holdfast::internal
