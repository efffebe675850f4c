#pragma once

#include <string_view>

#include "core/base/result.hpp"
#include "core/model/settings.hpp"
#include "io/input/text_file.hpp"
#include "io/loads/read_load.hpp"

namespace holdfast::internal {

/// What a file of loads is written in.
enum class LoadSyntax {
  text,   ///< StableCargo's: a header, then seven numbers per line
  table,  ///< rows of cells, whose header names the columns
  json,
};

/// The syntax of a text, by its beginning. A text whose first line names at least a place and a size is a table.
/// @param text a file, or enough of its beginning to contain the header
LoadSyntax load_syntax(std::string_view text);

/// Reads all loads of a file, and checks them. An error says why none of them can be read; what is wrong with a load
/// is among the loads.
///
/// Loads of tables and JSON have the hash of their canonical JSON, so that a load is known by what it is; a text of
/// StableCargo's has that of its bytes.
/// @param file UTF-8, UTF-16 or, where it is neither, Windows-1252
Result<LoadsOfFile> read_loads(const TextFile& file, const Settings& settings);

}  // namespace holdfast::internal
