#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_schema.hpp"

/// Part files: where they are and what range of the run they hold. For src/io only; throws `h5::Failure`.
namespace holdfast::internal {

/// What of a run a file holds. Accelerations are whole in every part.
struct PartRange {
  AxisCounts begin{};  ///< index in the run of the first entry of the file's datasets
  AxisCounts end{};    ///< one past the last
};

/// Folder of the parts of a results file, and the path of one; parts count from 1.
std::string parts_folder(const std::string& results_path);
std::string part_path(const std::string& results_path, std::uint64_t number);

/// Numbers of the finished parts in the folder, rising.
std::vector<std::uint64_t> list_parts(const std::string& results_path);

/// Removes the finished parts, and their folder when nothing else is in it.
void remove_parts(const std::string& results_path);

/// Removes what a kill left under temporary names: it holds nothing that can be used.
void remove_temporaries(const std::string& results_path);

void write_range_begin(const h5::File& file, const AxisCounts& begin);
AxisCounts read_range_begin(const h5::File& file);
PartRange read_range(const h5::File& file);

/// A failure, which says what differs, when the file is of a run of another fingerprint.
void check_same_run(const h5::File& file, const std::string& fingerprint);

/// What to do about a part that cannot be read.
inline constexpr const char* kCureOfPart =
    "remove this part and any behind it, and --resume simulates their worlds again";

/// Ranges of all finished parts. A failure, with its cure, when a part is missing, damaged, does not follow on the one
/// before, or is of a run of another fingerprint.
std::vector<PartRange> check_parts(const std::string& results_path, const std::string& fingerprint);

}  // namespace holdfast::internal
