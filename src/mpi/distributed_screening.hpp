#pragma once

#include "app/screening.hpp"

namespace holdfast::internal {

/// Most shards that a job is divided into: far more than ranks, so that the last ones end together, and few enough that
/// what a shard costs beside its worlds (30 ms, to open, lock and sync its file) is little. docs/guide/scaling.md
/// replays it.
inline constexpr std::uint64_t kMostShards = 16'384;

/// Runs a job on all ranks of MPI_COMM_WORLD: each takes the next shard from a counter until there are no more, and
/// rank 0 merges them. Called by all ranks with the same job. The results file has the bytes of `run_screening`, times
/// aside. What finished is in the folder of the shards, whatever ends the ranks, and a job that resumes goes on from
/// there.
/// @return the same on all ranks
ExitCode run_distributed(const ScreeningJob& job);

}  // namespace holdfast::internal
