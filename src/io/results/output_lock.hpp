#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"

namespace holdfast::internal {

/// Keeps a results file and its parts to one run: whoever holds the lock may write `<path>.parts/` and `path`.
///
/// The lock is the kernel's, on the file `<path>.parts/lock`: it ends with the process that holds it, however that
/// ends, so that nothing stale can be left by a kill.
class OutputLock {
 public:
  /// Makes the parts folder and takes the lock. An error when another run has it, or when the folder or the file in it
  /// cannot be made.
  /// @param warning is set when the file system knows no locks; the run is then not protected
  static Result<OutputLock> take(const std::string& results_path, std::optional<Error>& warning);

  OutputLock(OutputLock&& other) noexcept;
  OutputLock& operator=(OutputLock&& other) noexcept;
  /// Removes the lock's file, and the parts folder when nothing else is in it; then lets go.
  ~OutputLock();

 private:
  OutputLock(std::string folder, int descriptor) : folder_(std::move(folder)), descriptor_(descriptor) {}
  std::string folder_;
  int descriptor_ = -1;  ///< of the lock's file; -1 when moved from
};

}  // namespace holdfast::internal
