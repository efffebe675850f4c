#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Restricts a results file and its parts to one run: the holder of the lock may write `<path>.parts/` and `path`.
///
/// It is a lock of the kernel on the file `<path>.parts/lock`: it ends with its process, also when that is killed, so
/// that there are no stale locks.
class OutputLock {
 public:
  /// Creates the folder of the parts and takes the lock. An error if another run has it, or if the folder or the file
  /// in it cannot be created.
  /// @param warning is set if the file system has no locks; the run is then not protected
  static Result<OutputLock> take(const std::string& results_path, std::optional<Error>& warning);

  OutputLock(OutputLock&& other) noexcept;
  OutputLock& operator=(OutputLock&& other) noexcept;
  /// Removes the file of the lock, and the folder of the parts if it is otherwise empty; then releases the lock.
  ~OutputLock();

 private:
  OutputLock(std::string folder, int descriptor) : folder_(std::move(folder)), descriptor_(descriptor) {}
  std::string folder_;
  int descriptor_ = -1;  ///< of the file of the lock; -1 after a move
};

}  // namespace holdfast::internal
