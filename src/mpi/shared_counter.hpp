#pragma once

#include <mpi.h>

#include <cstdint>

namespace holdfast::internal {

/// A number that all ranks of MPI_COMM_WORLD count up together. It lies in the memory of rank 0, which need not take
/// part in a call of another rank.
class SharedCounter {
 public:
  /// Called by all ranks.
  SharedCounter() {
    const MPI_Aint bytes = rank() == 0 ? sizeof(std::uint64_t) : 0;
    MPI_Win_allocate(bytes, sizeof(std::uint64_t), MPI_INFO_NULL, MPI_COMM_WORLD, &number_, &window_);
    if (rank() == 0) *number_ = 0;
    MPI_Barrier(MPI_COMM_WORLD);
  }
  SharedCounter(const SharedCounter&) = delete;
  SharedCounter& operator=(const SharedCounter&) = delete;
  /// Called by all ranks.
  ~SharedCounter() { MPI_Win_free(&window_); }

  /// Adds to the number.
  /// @return what it was before
  std::uint64_t add(std::uint64_t summand) {
    std::uint64_t before = 0;
    MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, window_);
    MPI_Fetch_and_op(&summand, &before, MPI_UINT64_T, 0, 0, MPI_SUM, window_);
    MPI_Win_unlock(0, window_);
    return before;
  }

  static int rank() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
  }

 private:
  std::uint64_t* number_ = nullptr;
  MPI_Win window_ = MPI_WIN_NULL;
};

}  // namespace holdfast::internal
