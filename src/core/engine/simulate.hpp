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

/// How long after the end of the acceleration a world may go on when it ends by sleeping and no timeout is
/// given, s.
inline constexpr double kSleepingPatience = 60.0;

/// The time at which a world ends at the latest, s: the timeout, or the end of the acceleration.
double latest_end(const Acceleration& acceleration, const Settings& settings);

/// Runs every world of the batch from settling to its end and tells its recorder.
///
/// For each world: gravity alone for the settling time; the recorder's start at t = 0; every step, none of which
/// straddles a breakpoint of the acceleration; the end. A world whose state is no longer finite ends at the last
/// finite state, with `Status::non_finite`.
/// @param batch     columns of the worlds, in the layout's pose; holds the final states afterwards
/// @param recorders one a world, in the batch's order
/// @param abort     looked at after every step; when set, the rest is left undone
/// @return false when aborted: recorders of worlds that had not ended heard no `finish`
bool simulate(const Engine& engine, WorldBatch& batch, const Settings& settings, std::span<Recorder* const> recorders,
              const std::atomic<bool>& abort);

}  // namespace holdfast::internal
