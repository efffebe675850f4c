#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/base/result.hpp"
#include "core/model/acceleration.hpp"
#include "core/model/outcome.hpp"
#include "core/model/settings.hpp"
#include "core/model/side_impulse.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

/// What an engine computed for a world, and how accurate it was: HOLDFAST_COUNTER_FIELDS. The residual scale is 0 as
/// long as no step has a residual.
struct Counters {
  HOLDFAST_COUNTER_FIELDS(HOLDFAST_FOUND_MEMBER)
  double device_seconds = 0.0;  ///< for which the calling thread waited for a device on behalf of the world, s

  /// Takes the residual of a step over if it is the largest so far, relative to its scale.
  void note_residual(double residual, double scale) {
    // residual / scale > max_residual / residual_scale, for scales that may be zero.
    const bool first = max_residual == 0.0 && residual > 0.0;
    if (!first && residual * residual_scale <= max_residual * scale) return;
    max_residual = residual;
    residual_scale = scale;
  }
};

/// Properties of an engine that the scheduler and the checks need.
struct EngineTraits {
  std::string name;
  /// Largest number of layouts in one unit of work. 1: the engine shares nothing between worlds, and gets one world at
  /// a time. More: for a device, which gets the layouts with all their accelerations.
  std::size_t layouts_per_unit = 1;
  /// True when all worlds of a batch advance together, under any accelerations: by one call of `advance`.
  bool all_together = false;
  /// True when worlds can go back to where they were: `Simulation::mark` and `rewind`.
  bool rewinds = false;
  /// True when `Simulation::side_impulses` is measured, where the settings ask for wall forces.
  bool measures_walls = false;
  /// True when forces and friction may change while a world goes: `Simulation::set_force` and `set_friction`.
  bool takes_changes = false;
  /// True when the engine proves that a load rests: `Simulation::rests`.
  bool proves_rest = false;
  /// Longest step, s: far shorter samples of a curve come as one phase, see `grouped`. 0: as phases of their own.
  double longest_step = 0.0;
  /// Steps that a world takes in a second at least, 1/s.
  double steps_per_second = 0.0;
  /// True when surfaces that slide may have less friction than those that stick: `ContactSettings::kinetic_friction`.
  bool has_kinetic_friction = false;
  /// True when boxes may stand on anti-slip mats: `Box::mat`.
  bool has_mats = false;
};

/// A request to advance one world within its current phase, and the answer.
struct AdvanceRequest {
  std::size_t world = 0;  ///< index into the batch
  Phase phase;            ///< stretch of constant acceleration that contains the world's time
  double reached = 0.0;   ///< the engine's answer: the world's time now, s; exactly `phase.end` at the end of the phase
};

/// A force on a box from outside, beside gravity and contacts.
struct BoxForce {
  Vec3 force = Vec3::Zero();  ///< container frame, N
  Vec3 at = Vec3::Zero();     ///< where it acts, from the centre of mass, body axes: a point that goes with the box, m
};

/// Worlds inside an engine. Made by `Engine::build`; used by one thread at a time.
///
/// The result of a world depends on its own inputs only: not on its batch, nor on the order of calls for other worlds.
class Simulation {
 public:
  Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  virtual ~Simulation() = default;

  /// Advances each world from its current time by one step, never past the end of its phase. The worlds may be at
  /// different times. There is one request unless `EngineTraits::all_together`.
  ///
  /// The engine divides the phase into its own steps. Steps during which nothing moves may be taken all at once.
  virtual void advance(std::span<AdvanceRequest> requests) = 0;

  /// Remembers where a world is; it may be rewound to there any number of times, and then goes on in a new phase, as if
  /// it had not gone on before. Counters, status and forces are those of then. For engines with
  /// `EngineTraits::rewinds`.
  virtual void mark(std::size_t /*world*/) {}
  virtual void rewind(std::size_t /*world*/) {}

  /// Changes what acts on a world from where it is now on: the force on one of its boxes, which stays as it is until it
  /// is set again, and the laws of contact. The world goes on in a new phase, even if the acceleration is the old one.
  /// For engines with `EngineTraits::takes_changes`.
  virtual void set_force(std::size_t /*world*/, std::size_t /*box*/, const BoxForce& /*force*/) {}
  virtual void set_friction(std::size_t /*world*/, const ContactSettings& /*contact*/) {}

  /// True when the engine has proved, in the last `advance`, that every box rests until the acceleration changes: no
  /// step was computed. For engines with `EngineTraits::proves_rest`.
  virtual bool rests(std::size_t /*world*/) const { return false; }

  /// Writes a world's state into its range of `state`, in the container's frame.
  virtual void read_back(std::size_t world, StateColumns& state) const = 0;

  /// The impulses of the boxes on the sides of the container between the times of the last two `advance`, or since the
  /// start. For engines with `EngineTraits::measures_walls`, where the settings ask for wall forces.
  virtual SideImpulses side_impulses(std::size_t /*world*/) const { return {}; }

  /// The counters of the world up to its current time.
  virtual Counters counters(std::size_t world) const = 0;

  /// The problems that the engine itself has found with the world up to its current time.
  virtual Status status(std::size_t /*world*/) const { return Status::ok; }
};

/// A simulation that takes worlds forward one at a time.
class SteppedSimulation : public Simulation {
 public:
  void advance(std::span<AdvanceRequest> requests) final {
    for (AdvanceRequest& request : requests) request.reached = step(request.world, request.phase);
  }

 private:
  /// Takes the next step of a world, or several in which nothing moves; returns the time reached, s.
  virtual double step(std::size_t world, const Phase& phase) = 0;
};

/// A method of simulating boxes: the interface that Bullet, the native engine and device pipelines implement. It does
/// not change after it is made; all threads share it.
class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  virtual const EngineTraits& traits() const = 0;

  /// Builds the engine's state for all worlds of the batch, each at the start of its simulated time and in the
  /// pose that the batch's columns give. The batch must outlive the simulation.
  virtual std::unique_ptr<Simulation> build(const WorldBatch& batch) const = 0;
};

}  // namespace holdfast::internal
