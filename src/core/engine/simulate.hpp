#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>

#include "core/engine/engine.hpp"
#include "core/engine/recorder.hpp"
#include "core/model/layout.hpp"
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

/// The worlds of one load under several accelerations, one after the other. With an engine that rewinds, a load that
/// rests as it stands is built and settled once, and every further world goes on from there: each has the bits that it
/// has alone.
class LoadSimulation {
 public:
  /// All must outlive this.
  LoadSimulation(const Engine& engine, const Layout& layout, const Settings& settings)
      : engine_(engine), layout_(layout), settings_(settings) {}

  /// Simulates the load under the next acceleration.
  /// @return false when aborted: `finish` was not called
  bool run(const Acceleration& acceleration, Recorder& recorder, const std::atomic<bool>& abort);

 private:
  const Engine& engine_;
  const Layout& layout_;
  const Settings& settings_;
  WorldBatch batch_;                        ///< the load alone
  StateColumns layout_pose_;                ///< of it
  std::unique_ptr<Simulation> simulation_;  ///< marked where the load has settled; none where it cannot be used again
  std::optional<double> settled_;           ///< end of the step that proved the load to rest, s
};

}  // namespace holdfast::internal
