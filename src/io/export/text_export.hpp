#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// What keeps `export_text` from writing files of these names, told before the run that they are to tell of: a name
/// longer than the file system takes, a folder that cannot be made. Makes the folder when missing.
std::optional<Error> prepare_text_export(const std::string& folder, const std::vector<std::string>& layout_names,
                                         const std::vector<std::string>& acceleration_names,
                                         const std::string& batch_directory);

/// Writes the three kinds of text files of a complete results file into the folder (made when missing, files of
/// the same name replaced): `[SOLUTION]$Layout$Acceleration` with the raw samples, `[SOLUTION_RESUMED]$Layout
/// $Acceleration` with the outcome, a file a world each, and `[BATCH-RESUMED]$BatchDirectory` with one line a
/// world. A world that was not simulated has `nan` for its outcome. `$Layout` and `$Acceleration` are the file names
/// without extension; where two are equal the later ones end in `~2`, `~3`, …. The `$` signs stay:
/// `[SOLUTION]$loading_7$braking`.
/// @param batch_directory name for the file of the batch; its last part is used
std::optional<Error> export_text(const std::string& results_path, const std::string& folder,
                                 const std::string& batch_directory);

}  // namespace holdfast::internal
