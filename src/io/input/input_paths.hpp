#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Kind of an input file, by its content.
enum class InputKind { layout, acceleration, config, unknown };

/// Kind of a text, by its first two lines that are neither blank nor comments. `[section]` is a config. Otherwise the
/// second line decides, or the first if there is no second or it does not decide: `key = value` is a config, 5 columns
/// are an acceleration, 7 or more a layout, if at least half of the columns are numbers.
/// @param text a file, or enough of its beginning to contain these lines
InputKind classify(std::string_view text);

/// Kind of a file. Reads little more than the lines that decide; `unknown` if the file cannot be read.
InputKind classify_file(const std::string& path);

/// An input file.
struct InputFile {
  std::string path;
  InputKind kind = InputKind::unknown;
};

/// The input files that a list of paths refers to: a file itself, the files in a folder, and for `-` the paths on
/// `list`, one per line. The order is that of the list; within a folder, that of the bytes of the names. Hidden files
/// and sub-folders are left out; so are files of unknown kind in a folder, with a warning. A file in the list itself is
/// included whatever its content. Files with equal names in different folders are different files.
///
/// A path that does not exist is an error, and so is a folder or a list without any input.
Result<std::vector<InputFile>> find_inputs(std::span<const std::string> paths, std::istream& list,
                                           std::vector<Error>& warnings);

/// The same for one kind only: files of other known kinds in folders are left out silently.
Result<std::vector<std::string>> layout_paths(std::span<const std::string> paths, std::istream& list,
                                              std::vector<Error>& warnings);
Result<std::vector<std::string>> acceleration_paths(std::span<const std::string> paths, std::istream& list,
                                                    std::vector<Error>& warnings);

/// The two kinds of input of a batch folder, each in byte order of the names.
struct BatchFolder {
  std::vector<std::string> layouts;
  std::vector<std::string> accelerations;
};

/// Searches a batch folder. An error if it is not a folder, or has no layout, or no acceleration although it needs one.
Result<BatchFolder> read_batch_folder(const std::string& path, bool needs_accelerations, std::vector<Error>& warnings);

}  // namespace holdfast::internal
