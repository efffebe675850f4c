#pragma once

#include <cstddef>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/model/acceleration.hpp"
#include "core/model/settings.hpp"
#include "core/model/world.hpp"

namespace holdfast::internal {

/// How long all speeds must stay below the sleeping threshold before a load is at rest, where the engine proves no
/// rest, s.
inline constexpr double kSleepingTime = 0.5;

/// How long a world may continue after the end of the acceleration if it ends by sleeping and there is no timeout, s.
inline constexpr double kSleepingPatience = 60.0;

/// True when every box is slower than the threshold, in m/s and rad/s.
bool is_quiet(const StateView& state, double threshold);

/// The latest time at which a world ends, s: the timeout, or `RunOutSeconds` after the end of the acceleration.
double latest_end(const Acceleration& acceleration, const Settings& settings);

/// When a world ends whose load rests by then, s: the timeout, or the end of the acceleration.
double planned_end(const Acceleration& acceleration, const Settings& settings);

/// The phases that an engine is asked for from t = 0 on: those of the acceleration, far shorter samples than its
/// steps in groups, and that in which the load runs out.
std::vector<Phase> phases_for(const Engine& engine, const Acceleration& acceleration, const Settings& settings);

/// Where a world is on its way: it settles under gravity alone before t = 0, until it rests; goes as the acceleration
/// says; and runs out after the acceleration has ended, until it rests again. Without a timeout, which ends it.
class Journey {
 public:
  /// What has just come about.
  enum class Event {
    none,
    start,  ///< t = 0: the acceleration begins
    end,    ///< the world ends
  };

  Journey(const Engine& engine, const Acceleration& acceleration, const Settings& settings);

  /// True before t = 0.
  bool settles() const { return phase_ == 0 && settles_first_; }
  /// True after the end of the acceleration, where the world ends as soon as it rests.
  bool runs_out() const { return runs_out_ && phase_ + 1 == phases_.size(); }
  /// True when there is no time left, as from the begin where the timeout is 0.
  bool has_ended() const { return phase_ == phases_.size(); }

  /// The phase that contains the next step.
  const Phase& phase() const { return phases_[phase_]; }
  /// The time of the world, and where its last step began, s. They are equal after a step in which nothing was
  /// simulated, because the load was proved to rest and the world ends with that.
  double time() const { return time_; }
  double begin() const { return begin_; }

  /// Takes in a step, or several in which nothing moves.
  /// @param reached end of the step, s
  /// @param rests   the engine has proved that nothing moves in the phase, see `Simulation::rests`
  /// @param quiet   all speeds are below the sleeping threshold
  Event reach(double reached, bool rests, bool quiet);

  /// Begins what is left of the way at a time, with a new phase, because what acts on the world changes there: it ends
  /// at its latest end then, whether it rests or not.
  void cut(double time);
  /// The same with a constant acceleration of the container all the way, m/s². After `cut`.
  void set_acceleration(const Vec3& acceleration);

  /// True when the load was at rest at the end of the last step, as far as the engine can tell.
  bool is_at_rest() const { return at_rest_; }
  /// Why the world has ended.
  StopReason stop_reason() const { return stop_reason_; }

 private:
  std::vector<Phase> phases_;
  bool settles_first_ = false;  ///< the first phase is that of settling
  bool runs_out_ = false;       ///< the last phase is that of running out
  bool ends_by_sleeping_ = false;
  bool proves_rest_ = false;
  std::size_t phase_ = 0;
  double time_ = 0.0;
  double begin_ = 0.0;
  double quiet_since_ = 0.0;  ///< end of the last step in which a box was not slow, s
  double last_change_ = 0.0;  ///< from then on the acceleration is constant, s
  bool at_rest_ = false;
  StopReason stop_reason_ = StopReason::timeout;
};

}  // namespace holdfast::internal
