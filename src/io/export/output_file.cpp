#include "io/export/output_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace holdfast::internal {

OutputFile::OutputFile(const std::string& path) : path_(path) {
  std::error_code unknown;
  const std::filesystem::file_status status = std::filesystem::status(path, unknown);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw h5::Failure(Error{.file = path, .what = "is not a regular file", .accepted = "another name"});
  errno = 0;
  stream_.open(path, std::ios::binary | std::ios::trunc);
  if (!stream_) fail();
}

void OutputFile::write(std::string_view text) {
  errno = 0;
  if (!stream_.write(text.data(), static_cast<std::streamsize>(text.size()))) fail();
}

void OutputFile::close() {
  errno = 0;
  stream_.close();
  if (!stream_) fail();
}

void OutputFile::fail() const {
  throw h5::Failure(Error{.file = path_, .what = "cannot be written", .value = errno != 0 ? std::strerror(errno) : ""});
}

void make_output_folder(const std::string& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw h5::Failure(Error{.file = folder, .what = "cannot be created", .value = failure.message()});
}

}  // namespace holdfast::internal
