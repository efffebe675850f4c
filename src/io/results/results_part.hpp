#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/results/hdf5_file.hpp"
#include "io/results/results_schema.hpp"

/// Part files: their paths and the range of the run that they contain. For src/io only; throws `h5::Failure`.
namespace holdfast::internal {

/// The range of the run that a file contains. Every part contains all accelerations.
struct PartRange {
  AxisCounts begin{};  ///< index in the run of the first entry of the file's datasets
  AxisCounts end{};    ///< one past the last
};

/// Folder of the parts of a results file, and the path of one; parts count from 1.
std::string parts_folder(const std::string& results_path);
std::string part_path(const std::string& results_path, std::uint64_t number);

/// Numbers of the finished parts in the folder, in increasing order.
std::vector<std::uint64_t> list_parts(const std::string& results_path);

/// Removes the finished parts, and their folder if it is then empty.
void remove_parts(const std::string& results_path);

/// Removes temporary files that a kill has left: they are incomplete.
void remove_temporaries(const std::string& results_path);

void write_range_begin(const h5::File& file, const AxisCounts& begin);
AxisCounts read_range_begin(const h5::File& file);
PartRange read_range(const h5::File& file);

/// A failure that says what differs, if the file belongs to a run with another fingerprint.
void check_same_run(const h5::File& file, const std::string& fingerprint);

/// What to do about a part that cannot be read.
inline constexpr const char* kCureOfPart =
    "remove this part and all later ones; --resume then simulates their worlds again";

/// Ranges of all finished parts. A failure, with its cure, if a part is missing or damaged, does not continue the
/// previous one, or belongs to a run with another fingerprint.
std::vector<PartRange> check_parts(const std::string& results_path, const std::string& fingerprint);

}  // namespace holdfast::internal
