#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/world_record.hpp"

namespace holdfast::internal {

/// How far a run came.
struct Progress {
  bool complete = false;          ///< the results file itself is there: nothing is left to do
  std::uint64_t part_count = 0;   ///< finished parts
  std::uint64_t world_count = 0;  ///< worlds in them: the first so many of the run
  std::uint64_t box_count = 0;
  std::uint64_t sample_count = 0;
  std::uint64_t row_count = 0;
  std::uint64_t layout_box_count = 0;
  std::uint64_t layout_count = 0;  ///< layouts in them: the first so many of the run
  /// SHA-256 of all layouts of the run as they were when it began; empty where one could not be read. The caller
  /// compares them with the files as they are now.
  std::vector<std::string> layout_hashes;
};

/// What an earlier run left of the results file `path` and of its parts. Temporary files, and parts that are in the
/// results file already, are removed: the caller holds the `OutputLock`.
/// An error when a part or the results file belongs to other inputs (it says what differs), when a part is
/// damaged, or when one is missing in between.
/// @param fingerprint of the run to go on with
Result<Progress> find_finished(const std::string& path, const std::string& fingerprint);

/// Shows every finished world in the order of the run, as it was when it ended: without boxes and series.
/// @param progress what `find_finished` found there
std::optional<Error> visit_finished(const std::string& path, const Progress& progress,
                                    const std::function<void(const WorldRecord&)>& visit);

}  // namespace holdfast::internal
