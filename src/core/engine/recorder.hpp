#pragma once

#include "core/base/vector.hpp"
#include "core/engine/engine.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

/// The interval between two consecutive times at which the engine returns, usually one step.
struct Step {
  double begin = 0.0;                ///< s
  double end = 0.0;                  ///< s
  Vec3 acceleration = Vec3::Zero();  ///< of the container, m/s²
  StateView before;                  ///< at `begin`
  StateView after;                   ///< at `end`
  Status status = Status::ok;        ///< what the engine has found wrong with the world up to `end`
  /// Of the boxes on the sides of the container; null where the settings do not ask for wall forces.
  const SideImpulses* side_impulses = nullptr;
};

/// How a world ended.
struct Outcome {
  Status status = Status::ok;
  Caveat caveats = Caveat::none;
  StopReason stop_reason = StopReason::not_run;
  double end_time = 0.0;  ///< s
  Counters counters;
};

/// Records one world while it is simulated. The loop in `simulate.hpp` passes it every step; it keeps what it needs.
class Recorder {
 public:
  Recorder() = default;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  virtual ~Recorder() = default;

  /// Called once, first, with the load in the layout's pose.
  /// @param time at which the world begins, s: 0, or earlier where the load settles first
  virtual void start(const BoxView& boxes, const StateView& layout, double time) = 0;

  /// Called once, at t = 0, when the acceleration begins. Not for a world that is unstable.
  /// @param settled state after gravity alone; that of the layout without settling
  virtual void accelerate(const StateView& settled) = 0;

  /// Called for every step, in order; those before `accelerate` end at t = 0 or earlier.
  virtual void step(const Step& step) = 0;

  /// True when the step that was passed last decides the verdict, so that the world may end with it.
  virtual bool decided() const { return false; }

  /// True when a box was beyond a limit while the load settled: the world ends before it is accelerated.
  virtual bool is_unstable() const { return false; }

  /// Called once, last.
  virtual void finish(const Outcome& outcome, const StateView& end) = 0;
};

}  // namespace holdfast::internal
