#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/base/result.hpp"
#include "core/model/acceleration.hpp"
#include "core/model/settings.hpp"
#include "core/model/status.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

/// What an engine spent on a world, and how well it did.
struct Counters {
  std::uint64_t steps = 0;             ///< steps that the simulated time was cut into
  std::uint64_t steps_skipped = 0;     ///< of these, the ones proved to change nothing and not computed
  std::uint64_t solve_iterations = 0;  ///< of the contact solver, over all steps
  /// Largest change of a contact's velocity in the last iteration of a step, over what the pull adds in that step: the
  /// native engine's is |g − a| times the whole step, and where that is zero the number is in m/s; that of the others
  /// is g times the step, and without gravity the number stays 0. Worst of all steps.
  double max_residual = 0.0;
  /// Deepest that a box was inside another or inside a side, m. Worst of all steps; 0 where the engine does not
  /// measure it.
  double max_penetration = 0.0;
  double device_seconds = 0.0;  ///< that the calling thread waited for a device on the world's behalf, s
};

/// What the scheduler and the checks need to know of an engine.
struct EngineTraits {
  std::string name;
  /// Most layouts to hand out as one unit of work: 1 for an engine that shares nothing between worlds, which then gets
  /// one world at a time; many for a device, which gets them with all their accelerations.
  std::size_t layouts_per_unit = 1;
  /// True when all worlds of a batch advance together, whatever their accelerations: by one call of `advance`.
  bool all_together = false;
};

/// Asks to take a world forward inside a phase, and tells how far it came.
struct AdvanceRequest {
  std::size_t world = 0;     ///< index into the batch
  Phase phase;               ///< stretch of constant acceleration that contains the world's time
  double output_time = 0.0;  ///< next time that the caller needs a state for, s; not before the world's time
  double reached = 0.0;  ///< the engine's answer: the world's time now, s; exactly `phase.end` at the end of the phase
};

/// Worlds inside an engine. Made by `Engine::build`; used by one thread at a time.
///
/// A world's result depends on its own inputs alone: neither on its batch, nor on the order of calls for others.
class Simulation {
 public:
  Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  virtual ~Simulation() = default;

  /// Takes each world forward from where it is by one step or more, never past the end of its phase. The worlds' times
  /// differ; there is one request unless `EngineTraits::all_together`.
  ///
  /// The engine cuts the phase into its own steps. It may take several before it returns as long as it stops at the
  /// last step end not after `output_time` and at the first one after it: between these two the caller interpolates.
  /// Steps that provably change nothing may be taken at once, past `output_time`.
  virtual void advance(std::span<AdvanceRequest> requests) = 0;

  /// Writes a world's state into its range of `state`, in the container's frame.
  virtual void read_back(std::size_t world, StateColumns& state) const = 0;

  /// What the world has cost so far.
  virtual Counters counters(std::size_t world) const = 0;

  /// What the engine itself found wrong with the world so far.
  virtual Status status(std::size_t /*world*/) const { return Status::ok; }
};

/// A simulation that takes worlds forward one at a time, and returns after every step.
class SteppedSimulation : public Simulation {
 public:
  void advance(std::span<AdvanceRequest> requests) final {
    for (AdvanceRequest& request : requests) request.reached = step(request.world, request.phase);
  }

 private:
  /// Takes the next step of a world, or several in which nothing moves; returns the time reached, s.
  virtual double step(std::size_t world, const Phase& phase) = 0;
};

/// A way of moving boxes: the seam behind which Bullet, the native engine and device pipelines stand. Constant
/// once made; shared by all threads.
class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  virtual const EngineTraits& traits() const = 0;

  /// Builds the engine's state for all worlds of the batch, each at the start of its simulated time and in the
  /// pose of the batch's columns. The batch must outlive the simulation.
  virtual std::unique_ptr<Simulation> build(const WorldBatch& batch) const = 0;
};

}  // namespace holdfast::internal
