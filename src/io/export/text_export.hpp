#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// The reason why `export_text` cannot write files with these names, found before the run: a name is longer than the
/// file system allows, or the folder cannot be created. Creates the folder if it is missing.
std::optional<Error> prepare_text_export(const std::string& folder, const std::vector<std::string>& layout_names,
                                         const std::vector<std::string>& acceleration_names,
                                         const std::string& batch_directory);

/// Writes the three kinds of text files of a complete results file into the folder, which is created if it is missing;
/// files with the same names are replaced. There is one file per world with the samples,
/// `[SOLUTION]$Layout$Acceleration`, and one with the results, `[SOLUTION_RESUMED]$Layout$Acceleration`; and one file
/// with one line per world, `[BATCH-RESUMED]$BatchDirectory`. The results of a world that was not simulated are `nan`.
/// `Layout` and `Acceleration` are file names without extension; equal names get the endings `~2`, `~3`, …. The `$`
/// signs are part of the names: `[SOLUTION]$loading_7$braking`.
/// @param batch_directory path whose last part is in the name of the file of the batch
std::optional<Error> export_text(const std::string& results_path, const std::string& folder,
                                 const std::string& batch_directory);

}  // namespace holdfast::internal
