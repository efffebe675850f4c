#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/engine/recorder.hpp"
#include "core/model/settings.hpp"
#include "validate/laboratory/scene.hpp"

namespace holdfast::internal {

/// An engine with a choice of its solver's settings: one curve's point, one column of the tables.
struct EngineSetting {
  std::string engine;                     ///< name of the engine
  std::string name;                       ///< of the setting: "240 Hz, 50 it, 2F R"
  std::function<void(Settings&)> choose;  ///< sets step and solver in a scene's settings
  bool quick = false;                     ///< part of a quick run
  bool reference = false;                 ///< one of the references of the load suite
  bool loads = true;                      ///< taken through the load suite; not where a load costs minutes
  bool quick_cases_only = false;          ///< of a device: a step of one box takes it as long as one of a full load
};

/// Makes an engine by name. The laboratory does not know how.
using EngineFactory = std::function<Result<std::unique_ptr<Engine>>(const std::string& name, const Settings& settings)>;

/// What an observer sees after each step: all in double, as the engine has it.
struct Moment {
  double time = 0.0;  ///< s
  double step = 0.0;  ///< length of the step that ended, s; 0 at the start
  StateView state;
};

/// Sees the start and every step end. Returns false when it has seen enough: the run ends there.
using Observer = std::function<bool(const Moment&)>;

/// What running scenes cost, and how the runs ended.
struct RunCost {
  double cpu_seconds = 0.0;
  double box_seconds = 0.0;  ///< boxes that can move, times simulated seconds
};

/// Runs scenes on one engine and setting, and adds up what that costs.
class Laboratory {
 public:
  /// @param abort ends the run in progress when set
  Laboratory(EngineFactory factory, const EngineSetting& setting, const std::atomic<bool>& abort);

  /// Runs the scene from its start to the end of its motion, or until the observer has seen enough.
  /// Without gravity-only settling unless the scene's settings ask for it. A world that fails (not finite) ends early;
  /// the observer then has not seen the end.
  Outcome run(const Scene& scene, const Observer& observer);

  /// Runs several scenes as the worlds of one batch, with the settings of the first and an observer each, until all
  /// have ended or all observers have seen enough.
  std::vector<Outcome> run(std::span<const Scene> scenes, std::span<const Observer> observers);

  const EngineSetting& setting() const { return setting_; }
  const RunCost& cost() const { return cost_; }

 private:
  EngineFactory factory_;
  const EngineSetting& setting_;
  const std::atomic<bool>& abort_;
  RunCost cost_;
};

/// States at given times, linearly interpolated between step ends; what most cases ask for.
struct Snapshot {
  double time = 0.0;
  std::vector<Vec3> position;
  std::vector<Rotation> orientation;
  std::vector<Vec3> velocity;
  std::vector<Vec3> angular_velocity;
};

/// Runs the scene and returns the last state it reached.
Snapshot final_state(Laboratory& laboratory, const Scene& scene);

/// Runs the scenes as the worlds of one batch and returns the last state that each reached.
std::vector<Snapshot> final_states(Laboratory& laboratory, std::span<const Scene> scenes);

/// Largest distance of any box from where it began, at any step of the run, m. Infinite when the run failed.
double largest_displacement(Laboratory& laboratory, const Scene& scene);

/// Angle by which a body is turned from the identity, rad.
double turn_of(const Rotation& container_from_body);

/// The first time at which `quantity` of the state reaches `level` from below, linearly interpolated between step
/// ends, s; infinity when it never does.
double time_to_reach(Laboratory& laboratory, const Scene& scene, double level,
                     const std::function<double(const StateView&)>& quantity);

/// The smallest amplitude at which `exceeds` is true, by bisection, to a share of `precision`; assumes one border
/// between `low` (false) and `high` (true). `high` when it is false even there; `low` when it is true already there.
double smallest_amplitude(double low, double high, double precision, const std::function<bool(double)>& exceeds);

}  // namespace holdfast::internal
