#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/result_sink.hpp"

namespace holdfast::internal {

/// The progress of a run.
struct Progress {
  bool complete = false;          ///< the results file exists: nothing remains to be done
  std::uint64_t part_count = 0;   ///< finished parts
  std::uint64_t world_count = 0;  ///< worlds in them: that many first worlds of the run
  std::uint64_t box_count = 0;
  std::uint64_t sample_count = 0;
  std::uint64_t row_count = 0;
  std::uint64_t layout_box_count = 0;
  std::uint64_t layout_count = 0;  ///< layouts in them: that many first layouts of the run
  /// SHA-256 of all layouts of the run when it began; empty for one that could not be read. The caller compares them
  /// with the present files.
  std::vector<std::string> layout_hashes;
};

/// Finds the results file `path` or the parts of an earlier run. Temporary files, and parts that are already in the
/// results file, are removed: the caller holds the `OutputLock`.
/// An error if a part or the results file belongs to other inputs (it says what differs), if a part is damaged, or if
/// one is missing before another.
/// @param fingerprint of the run to resume
Result<Progress> find_finished(const std::string& path, const std::string& fingerprint);

/// Called with what an earlier run finished.
struct FinishedVisitor {
  std::function<void(const WorldRecord&)> world;  ///< without boxes and series
  /// With boxes that have their names alone, and none where no box has one; may be empty.
  std::function<void(const LayoutRecord&)> layout_begins = nullptr;
  /// Of a run that was asked for analyses of layouts, with these; may be empty.
  std::function<void(const LayoutRecord&)> layout = nullptr;
};

/// Calls the visitor with every finished world and layout, part by part in the order of the run; within a part the
/// layouts are first.
/// @param progress from `find_finished`
std::optional<Error> visit_finished(const std::string& path, const Progress& progress, const FinishedVisitor& visitor);

}  // namespace holdfast::internal
