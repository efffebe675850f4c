#include "io/export/text_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <span>

#include "io/results/durable_file.hpp"
#include "io/results/hdf5_file.hpp"

namespace holdfast::internal {

namespace {

namespace fs = std::filesystem;

Error cannot_be_written(const std::string& path) {
  return {.file = path, .what = "cannot be written", .value = std::strerror(errno)};
}

/// The file that a symbolic link refers to, so that writing does not replace the link.
std::string target_of(const std::string& path) {
  std::error_code missing;
  if (!fs::is_symlink(path, missing)) return path;
  const fs::path target = fs::canonical(path, missing);
  return missing ? path : target.string();
}

}  // namespace

std::optional<Error> write_text_file(const std::string& path, std::string_view text) {
  return h5::caught(path, [&] { write_durably(target_of(path), std::as_bytes(std::span(text))); });
}

std::optional<Error> check_output_file(const std::string& path,
                                       const std::function<bool(const std::string&)>& is_same_kind) {
  if (path.empty()) return Error{.what = "an empty path", .accepted = "the name of a file"};
  std::error_code unknown;
  const fs::file_status status = fs::status(path, unknown);
  if (fs::is_directory(status)) return Error{.file = path, .what = "is a folder", .accepted = "the name of a file"};
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status))
      return Error{.file = path, .what = "is not a regular file", .accepted = "another name"};
    if (fs::file_size(path, unknown) > 0 && !is_same_kind(path))
      return Error{.file = path, .what = "is a file of another kind, and is not replaced", .accepted = "another name"};
    if (::access(path.c_str(), W_OK) != 0) return cannot_be_written(path);
  }
  // Only an attempt shows whether permissions, the folder and the file system allow writing.
  const std::string temporary = temporary_name(target_of(path));
  const Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
  if (file.number < 0) return cannot_be_written(path);
  ::unlink(temporary.c_str());
  return std::nullopt;
}

}  // namespace holdfast::internal
