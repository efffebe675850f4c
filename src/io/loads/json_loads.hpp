#pragma once

#include <string>
#include <string_view>

#include "core/base/result.hpp"
#include "core/model/settings.hpp"
#include "io/loads/read_load.hpp"
#include "io/loads/table_loads.hpp"

namespace holdfast::internal {

/// Deepest nesting of lists and objects that is read.
inline constexpr int kDeepestJson = 60;

/// Loads that are written in JSON, not checked yet.
///
/// An object with the key `holdfast` is ours: `{"holdfast": 1, "unit": "m", "loads": [{"name", "container",
/// "boxes"}]}`, or one load per line after a first line `{"holdfast": 1}`; docs/start/loads.md describes its keys. Any
/// other JSON is taken as tables: each list of objects is one, keys of objects in objects are joined by points
/// (`center.x`), and what stands above a table is said of all its rows. Of several such lists each is a load.
/// @param path of the file, for messages
/// @param name of the file, without the folder
Result<LoadsOfFile> read_json_loads(std::string_view text, const std::string& path, const std::string& name,
                                    const TableChoices& choices, const Settings& settings);

/// Whether a text is JSON by its first characters: an object, or a list of objects or lists.
bool looks_like_json(std::string_view text);

}  // namespace holdfast::internal
