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

/// Whether the name still leads to the open file: the run that had the lock before removes it as it ends.
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
    if (failure) return Error{.file = folder, .what = "cannot be made", .value = failure.message()};
    if (made) {
      // Else a power cut could take the folder with all that is safe in it.
      if (const auto error = h5::caught(folder, [&] { sync_entry(folder); })) return *error;
    }
    OutputLock lock(folder, ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (lock.descriptor_ < 0 && errno == ENOENT) continue;  // the run before has just removed the folder
    if (lock.descriptor_ < 0) return system_error(path, "cannot be made");
    if (lock_now(lock.descriptor_) == 0) {
      if (is_still_there(path, lock.descriptor_)) return lock;
    } else if (errno == EWOULDBLOCK) {
      ::close(std::exchange(lock.descriptor_, -1));  // it is not ours to remove
      return Error{.file = results_path,
                   .what = "is being written by another run",
                   .accepted = "wait for its end, or give another name"};
    } else {
      // Some parallel file systems know no locks; that must not keep anybody from working there.
      warning = system_error(path, "cannot be locked, so take care that no other run writes here");
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
  // While it is still held: who opened the file meanwhile finds it gone once he has the lock, and begins anew.
  ::unlink(lock_path(folder_).c_str());
  ::rmdir(folder_.c_str());
  ::close(descriptor_);
}

}  // namespace holdfast::internal
