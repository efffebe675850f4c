#pragma once

#include <fstream>
#include <string>
#include <string_view>

#include "io/results/hdf5_file.hpp"
namespace holdfast::internal {

/// A text file that is written sequentially; every failure is thrown as `h5::Failure`. For src/io only.
class OutputFile {
 public:
  /// A new file, or one in the place of a regular file; nothing else is opened, since a pipe would wait for a reader.
  explicit OutputFile(const std::string& path);
  void write(std::string_view text);
  /// Closes the file. Also reports earlier failures: a full disk may be noticed only here.
  void close();

 private:
  [[noreturn]] void fail() const;
  std::string path_;
  std::ofstream stream_;
};

/// Creates the folder and those above it if they are missing.
void make_output_folder(const std::string& folder);

}  // namespace holdfast::internal
