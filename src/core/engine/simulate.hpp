#pragma once

#include <atomic>
#include <span>

#include "core/engine/engine.hpp"
#include "core/engine/recorder.hpp"
#include "core/model/settings.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

/// How much of its simulated time a world was spared, since it ended early by StopWhen or was left out by FirstFailure,
/// s; 0 for every other.
/// @param planned_end of the world, see `planned_end`
double time_saved(Status status, StopReason stop_reason, double end_time, double planned_end);

/// Simulates every world of the batch from settling to its end, and passes the steps to its recorder.
///
/// For each world, as `Journey` says: gravity alone until the load rests; from t = 0 every step, none of which crosses
/// the end of a phase; the end, early when the recorder has decided. A world whose load goes beyond a limit while it
/// settles is not accelerated. A world whose state is no longer finite ends at the last finite state, with
/// `Status::non_finite`.
/// @param batch     columns of the worlds, in the layout's pose; holds the final states afterwards
/// @param recorders one per world, in the order of the batch
/// @param abort     checked after every step; when it is set, the simulation stops
/// @return false when aborted: `finish` was not called for the recorders of worlds that had not ended
bool simulate(const Engine& engine, WorldBatch& batch, const Settings& settings, std::span<Recorder* const> recorders,
              const std::atomic<bool>& abort);

}  // namespace holdfast::internal
