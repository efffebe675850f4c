#pragma once

#include <atomic>
#include <span>

#include "core/engine/engine.hpp"
#include "core/engine/recorder.hpp"
#include "core/model/settings.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

/// How long all speeds must stay below the sleeping threshold before a world ends, s.
inline constexpr double kSleepingTime = 0.5;

/// How long a world may continue after the end of the acceleration if it ends by sleeping and there is no timeout, s.
inline constexpr double kSleepingPatience = 60.0;

/// The latest time at which a world ends, s: the timeout, or the end of the acceleration.
double latest_end(const Acceleration& acceleration, const Settings& settings);

/// How much of its simulated time a world was spared, since it ended early by StopWhen or was left out by FirstFailure,
/// s; 0 for every other.
/// @param latest_end as above
double time_saved(Status status, StopReason stop_reason, double end_time, double latest_end);

/// The phases that an engine is asked for: those of the acceleration, resampled where they are far shorter than its
/// steps.
/// @param end end of the simulated time, s
std::vector<Phase> phases_for(const Engine& engine, const Acceleration& acceleration, double end);

/// Simulates every world of the batch from settling to its end, and passes the steps to its recorder.
///
/// For each world: gravity alone for the settling time; the start of the recorder at t = 0; every step, none of which
/// crosses the end of a phase (`phases_for`); the end, early when the recorder has decided. A world whose state is no
/// longer finite ends at the last finite state, with `Status::non_finite`.
/// @param batch     columns of the worlds, in the layout's pose; holds the final states afterwards
/// @param recorders one per world, in the order of the batch
/// @param abort     checked after every step; when it is set, the simulation stops
/// @return false when aborted: `finish` was not called for the recorders of worlds that had not ended
bool simulate(const Engine& engine, WorldBatch& batch, const Settings& settings, std::span<Recorder* const> recorders,
              const std::atomic<bool>& abort);

}  // namespace holdfast::internal
