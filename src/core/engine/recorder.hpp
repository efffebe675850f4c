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
  /// Of the boxes on the sides of the container; null where the settings do not ask for wall forces.
  const SideImpulses* side_impulses = nullptr;
};

/// How a world ended.
struct Outcome {
  Status status = Status::ok;
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

  /// Called once, at t = 0. Without settling both states are the same.
  /// @param layout  state in the layout's pose
  /// @param settled state after gravity alone
  virtual void start(const BoxView& boxes, const StateView& layout, const StateView& settled) = 0;

  /// The next time at which the recorder needs the state, s: two consecutive ends of steps must enclose it. Infinity
  /// when there is none.
  virtual double output_time() const = 0;

  /// Called for every step from t = 0 on, in order.
  virtual void step(const Step& step) = 0;

  /// True when the step that was passed last answers the question of the recorder, so that the world may end with it.
  virtual bool decided() const { return false; }

  /// Called once, last.
  virtual void finish(const Outcome& outcome, const StateView& end) = 0;
};

}  // namespace holdfast::internal
