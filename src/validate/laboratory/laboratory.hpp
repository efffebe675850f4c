#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/engine/recorder.hpp"
#include "core/model/settings.hpp"
#include "validate/laboratory/scene.hpp"

namespace holdfast::internal {

/// An engine with settings of its solver: one point of a curve in the report, one column of its tables.
struct EngineSetting {
  std::string engine;                     ///< name of the engine
  std::string name;                       ///< of the setting: "240 Hz, 50 it, 2F R"
  std::function<void(Settings&)> choose;  ///< sets step and solver in a scene's settings
  bool quick = false;                     ///< part of a quick run
  bool reference = false;                 ///< one of the references of the load suite
  bool loads = true;                      ///< part of the load suite; false if a loading takes minutes
  bool quick_cases_only = false;  ///< for a device, where a step of one box takes as long as one of a full container
};

/// Creates an engine by name; provided by the user of the laboratory.
using EngineFactory = std::function<Result<std::unique_ptr<Engine>>(const std::string& name, const Settings& settings)>;

/// The data passed to an observer after each step, in double precision as in the engine.
struct Moment {
  double time = 0.0;  ///< s
  double step = 0.0;  ///< length of the step that ended, s; 0 at the start
  StateView state;
};

/// Called at the start and after every step. Returns false to end the run.
using Observer = std::function<bool(const Moment&)>;

/// Cost of running scenes, and how the runs ended.
struct RunCost {
  double cpu_seconds = 0.0;
  double box_seconds = 0.0;  ///< boxes that can move, times simulated seconds
};

/// Runs scenes on one engine and setting, and adds up their cost.
class Laboratory {
 public:
  /// @param abort ends the run in progress when set
  Laboratory(EngineFactory factory, const EngineSetting& setting, const std::atomic<bool>& abort);

  /// Runs the scene from its start to the end of its acceleration, or until the observer has finished. There is no
  /// settling unless the scene's settings require it. A world that fails (not finite) ends early; the observer is then
  /// not called for the end.
  Outcome run(const Scene& scene, const Observer& observer);

  /// Runs several scenes as the worlds of one batch, with the settings of the first and one observer each, until all
  /// have ended or all observers have finished.
  std::vector<Outcome> run(std::span<const Scene> scenes, std::span<const Observer> observers);

  const EngineSetting& setting() const { return setting_; }
  const RunCost& cost() const { return cost_; }

 private:
  EngineFactory factory_;
  const EngineSetting& setting_;
  const std::atomic<bool>& abort_;
  RunCost cost_;
};

/// States at given times, linearly interpolated between the ends of steps; most cases need only these.
struct Snapshot {
  double time = 0.0;
  std::vector<Vec3> position;
  std::vector<Rotation> orientation;
  std::vector<Vec3> velocity;
  std::vector<Vec3> angular_velocity;
};

/// Runs the scene and returns its last state.
Snapshot final_state(Laboratory& laboratory, const Scene& scene);

/// The same; nothing if the engine cannot model the scene, and no numbers as positions if the run failed.
std::optional<Snapshot> final_state_if_any(Laboratory& laboratory, const Scene& scene);

/// Runs the scenes as the worlds of one batch and returns the last state of each.
std::vector<Snapshot> final_states(Laboratory& laboratory, std::span<const Scene> scenes);

/// Largest distance of any box from its start, over all steps of the run, m. Infinite if the run failed.
double largest_displacement(Laboratory& laboratory, const Scene& scene);

/// Angle of a rotation, rad.
double turn_of(const Rotation& container_from_body);

/// The first time at which `quantity` of the state reaches `level` from below, linearly interpolated between the ends
/// of steps, s; infinity if it never does.
double time_to_reach(Laboratory& laboratory, const Scene& scene, double level,
                     const std::function<double(const StateView&)>& quantity);

/// The smallest amplitude at which `exceeds` is true, by bisection to the relative precision `precision`; assumes one
/// threshold between `low` (false) and `high` (true). `high` if it is false even there; `low` if it is already true
/// there.
double smallest_amplitude(double low, double high, double precision, const std::function<bool(double)>& exceeds);

}  // namespace holdfast::internal
