#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// What an input file is, by its content.
enum class InputKind { layout, acceleration, config, unknown };

/// What a text is, judged by its first two lines that are neither blank nor comments: `[section]` makes a config; else
/// the second line decides, or the first where that is alone or undecided: `key = value` makes a config, 5 columns an
/// acceleration, 7 or more a layout, if at least half of these are numbers.
/// @param text a file, or so much of its beginning as has these lines
InputKind classify(std::string_view text);

/// What a file is. Reads little more of it than the lines that decide; `unknown` when it cannot be read.
InputKind classify_file(const std::string& path);

/// An input file that was found.
struct InputFile {
  std::string path;
  InputKind kind = InputKind::unknown;
};

/// The files that a user means: every path stands for itself when it is a file, for the files in it when it is a
/// folder, and `-` for the paths on `list`, one a line. Order is the user's, inside a folder that of the bytes of the
/// names. Hidden files and sub-folders are left out; files of unknown kind in a folder too, with a warning. A path that
/// was named itself is taken whatever its content. Files of the same name are different files.
///
/// A path that does not exist, a folder or a list without any input is an error.
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

/// Looks through a batch folder. An error when it is no folder, or has no layout or no acceleration.
Result<BatchFolder> read_batch_folder(const std::string& path, std::vector<Error>& warnings);

}  // namespace holdfast::internal
