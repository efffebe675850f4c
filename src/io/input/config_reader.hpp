#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/settings.hpp"
#include "io/input/text_file.hpp"

namespace holdfast::internal {

/// A config.ini as it was read.
struct Config {
  Settings settings;   ///< defaults for keys that the file does not give
  std::string path;    ///< as the user wrote it
  std::string text;    ///< all bytes, for the results file
  std::string sha256;  ///< of the bytes, 64 hexadecimal digits
  /// Section and name of every key that the file gives; aliases by their main name, materials as `Material 3`.
  std::set<std::pair<std::string, std::string>> given;
};

/// Reads a config.ini with the table of keys (see setting_table). `;` and `#` begin a comment line, white space and `;`
/// a comment after a value; `:` may replace `=`; indentation has no meaning; a section may occur twice, a key may not.
/// Relative paths are not changed: they are relative to the current folder of the process, not to that of the file.
///
/// All errors of the file are reported, up to the limit of ErrorList; contradictions between keys only if there is no
/// other error.
/// @param warnings receives one entry per key without effect
Result<Config> parse_config(const TextFile& file, std::vector<Error>& warnings);

}  // namespace holdfast::internal
