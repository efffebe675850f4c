#pragma once

#include <functional>
#include <string>

#include "app/exit_code.hpp"

namespace holdfast::internal {

/// Memory that reading a file takes at most, beside what the program has anyway, MB per thread.
inline constexpr int kReadingMemory = 512;

/// An HDF5 file of unknown origin, or several under one name, and what reading it may take.
struct GuardedFile {
  std::string path;
  std::string cure;             ///< what to do when it is damaged
  int memory = kReadingMemory;  ///< MB, for each thread
  int threads = 1;              ///< that the work starts
};

/// Does work that reads HDF5 files in a process of its own, and passes on its exit code.
///
/// HDF5 1.10 trusts what a file says of itself: a single wrong byte can make it read beyond a buffer, allocate
/// gigabytes, or never return. When the child crashes, takes too much memory, or takes long for a single call, the
/// parent lives, says what is wrong with `path`, and returns `bad_usage`. SIGINT and SIGTERM reach the child. Only for
/// a process that has one thread. What the work changes in memory is lost.
ExitCode guard_reading(const GuardedFile& file, const std::function<ExitCode()>& work);

/// Called by guarded work that reads no more: what it does from then on may take any time.
void reading_has_ended();

}  // namespace holdfast::internal
