#include "io/results/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "io/results/hdf5_file.hpp"

namespace holdfast::internal {

namespace {

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw h5::Failure(Error{.file = path, .what = what, .value = std::strerror(errno)});
}

void write_all(int descriptor, std::span<const std::byte> bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(path, "cannot be written");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void sync_file(const std::string& path, int flags) {
  const Descriptor file(::open(path.c_str(), flags | O_CLOEXEC));
  if (file.number < 0 || ::fsync(file.number) != 0) fail(path, "cannot be written to disk");
}

}  // namespace

Descriptor::~Descriptor() {
  if (number >= 0) ::close(number);
}

BytesOfFile::BytesOfFile(std::string path)
    : path_(std::move(path)), file_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (file_.number < 0) fail(path_, "cannot be opened");
}

std::vector<std::byte> BytesOfFile::read(std::uint64_t begin, std::uint64_t count) const {
  std::vector<std::byte> bytes(count);
  for (std::uint64_t done = 0; done < count;) {
    const ssize_t some = ::pread(file_.number, bytes.data() + done, count - done, static_cast<off_t>(begin + done));
    if (some < 0 && errno == EINTR) continue;
    if (some < 0) fail(path_, "cannot be read");
    if (some == 0) throw h5::Failure(Error{.file = path_, .what = "lacks a part of its data"});
    done += static_cast<std::uint64_t>(some);
  }
  return bytes;
}

void commit_temporary(const std::string& path) {
  const std::string temporary = temporary_name(path);
  sync_file(temporary, O_RDWR);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "cannot be renamed into place");
  sync_entry(path);
}

void sync_entry(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  sync_file(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
}

void write_durably(const std::string& path, std::span<const std::byte> bytes) {
  const std::string temporary = temporary_name(path);
  try {
    const Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.number < 0) fail(path, "cannot be created");
    write_all(file.number, bytes, path);
    commit_temporary(path);
  } catch (const h5::Failure&) {
    ::unlink(temporary.c_str());
    throw;
  }
}

}  // namespace holdfast::internal
