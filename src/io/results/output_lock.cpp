#include "io/results/output_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "io/results/durable_file.hpp"
#include "io/results/hdf5_file.hpp"
#include "io/results/results_part.hpp"

namespace holdfast::internal {

namespace {

std::string lock_path(const std::string& folder) { return folder + "/lock"; }

Error system_error(const std::string& file, const char* what) {
  return {.file = file, .what = what, .value = std::strerror(errno)};
}

/// Whether the name still refers to the open file: the previous holder of the lock removes the file when it ends.
bool is_still_there(const std::string& path, int descriptor) {
  struct stat named = {};
  struct stat open = {};
  return ::stat(path.c_str(), &named) == 0 && ::fstat(descriptor, &open) == 0 && named.st_dev == open.st_dev &&
         named.st_ino == open.st_ino;
}

int lock_now(int descriptor) {
  int outcome = -1;
  do {
    outcome = ::flock(descriptor, LOCK_EX | LOCK_NB);
  } while (outcome != 0 && errno == EINTR);
  return outcome;
}

}  // namespace

Result<OutputLock> OutputLock::take(const std::string& results_path, std::optional<Error>& warning) {
  const std::string folder = parts_folder(results_path);
  const std::string path = lock_path(folder);
  while (true) {
    std::error_code failure;
    const bool made = std::filesystem::create_directories(folder, failure);
    if (failure) return Error{.file = folder, .what = "cannot be created", .value = failure.message()};
    if (made) {
      // Otherwise a power cut could remove the folder with all parts in it.
      if (const auto error = h5::caught(folder, [&] { sync_entry(folder); })) return *error;
    }
    OutputLock lock(folder, ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (lock.descriptor_ < 0 && errno == ENOENT) continue;  // the previous run has just removed the folder
    if (lock.descriptor_ < 0) return system_error(path, "cannot be created");
    if (lock_now(lock.descriptor_) == 0) {
      if (is_still_there(path, lock.descriptor_)) return lock;
    } else if (errno == EWOULDBLOCK) {
      ::close(std::exchange(lock.descriptor_, -1));  // another run owns the file; it must not be removed here
      return Error{.file = results_path,
                   .what = "is being written by another run",
                   .accepted = "wait until it ends, or give another name"};
    } else {
      // Some parallel file systems have no locks; the run continues there without protection.
      warning = system_error(path, "cannot be locked; make sure that no other run writes here");
      return lock;
    }
    ::close(std::exchange(lock.descriptor_, -1));
  }
}

OutputLock::OutputLock(OutputLock&& other) noexcept
    : folder_(std::move(other.folder_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputLock& OutputLock::operator=(OutputLock&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

OutputLock::~OutputLock() {
  if (descriptor_ < 0) return;
  // Removed while the lock is still held: a process that has opened the file meanwhile finds it removed when it gets
  // the lock, and starts again.
  ::unlink(lock_path(folder_).c_str());
  ::rmdir(folder_.c_str());
  ::close(descriptor_);
}

}  // namespace holdfast::internal
