#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/engine/step_plan.hpp"

namespace holdfast::internal::scenes {

/// What a scripted engine does.
struct Script {
  double steps_per_second = 240.0;
  bool proves_rest = false;  ///< once it stands still: the rest of a phase is taken at once
  bool all_together = false;
  double breaks_at = std::numeric_limits<double>::infinity();    ///< s; the state is not a number from here on
  std::size_t breaking_world = 0;                                ///< of the batch
  double still_from = std::numeric_limits<double>::infinity();   ///< s; all boxes stand still from here on
  Status status = Status::ok;                                    ///< that the engine reports for every world
  double fails_from = -std::numeric_limits<double>::infinity();  ///< s; that it reports from here on
};

/// An engine without contacts: every box feels −a(t) and nothing else, and moves exactly as it should,
/// x ← x + v h + ½ (−a) h², v ← v − a h. Boxes turn about z at 1 rad/s.
class ScriptedEngine final : public Engine {
 public:
  explicit ScriptedEngine(const Script& script) : script_(script) {
    traits_.name = "scripted";
    traits_.all_together = script.all_together;
    traits_.proves_rest = script.proves_rest;
  }
  const EngineTraits& traits() const override { return traits_; }
  std::unique_ptr<Simulation> build(const WorldBatch& batch) const override {
    return std::make_unique<ScriptedSimulation>(batch, script_);
  }

 private:
  class ScriptedSimulation final : public SteppedSimulation {
   public:
    ScriptedSimulation(const WorldBatch& batch, const Script& script)
        : worlds_(batch.worlds), state_(batch.state), script_(script), counters_(batch.worlds.size()) {
      time_.resize(batch.worlds.size());
    }

    double step(std::size_t world, const Phase& phase) override {
      const StepPlan plan(phase, script_.steps_per_second);
      double& time = time_[world];
      if (counters_[world].steps == 0) time = phase.begin;
      rests_ = script_.proves_rest && time >= script_.still_from;
      if (rests_) return time = phase.end;
      const std::uint64_t step = plan.steps_before(time);
      move(world, phase.acceleration, std::exchange(time, plan.end_of(step)), plan.end_of(step));
      return time;
    }

    void read_back(std::size_t world, StateColumns& state) const override {
      for (std::size_t i = 0; i < worlds_[world].box_count; ++i) {
        const std::size_t row = worlds_[world].box_begin + i;
        state.position[row] = state_.position[row];
        state.orientation[row] = state_.orientation[row];
        state.velocity[row] = state_.velocity[row];
        state.angular_velocity[row] = state_.angular_velocity[row];
      }
    }
    Counters counters(std::size_t world) const override { return counters_[world]; }
    Status status(std::size_t world) const override {
      return time_[world] >= script_.fails_from ? script_.status : Status::ok;
    }
    bool rests(std::size_t) const override { return rests_; }

   private:
    void move(std::size_t world, const Vec3& acceleration, double begin, double end) {
      const double step = end - begin;
      ++counters_[world].steps;
      for (std::size_t i = 0; i < worlds_[world].box_count; ++i) {
        const std::size_t row = worlds_[world].box_begin + i;
        Vec3& v = state_.velocity[row];
        state_.position[row] += v * step - 0.5 * acceleration * step * step;
        v -= acceleration * step;
        state_.orientation[row] = Rotation(Eigen::AngleAxisd(step, Eigen::Vector3d::UnitZ())) * state_.orientation[row];
        state_.orientation[row].normalize();
        state_.angular_velocity[row] = Vec3::UnitZ();
        if (end > script_.still_from) v = state_.angular_velocity[row] = Vec3::Zero();
        if (end > script_.breaks_at && world == script_.breaking_world)
          v.y() = std::numeric_limits<double>::quiet_NaN();
      }
    }

    const std::vector<World>& worlds_;
    StateColumns state_;
    Script script_;
    bool rests_ = false;
    std::vector<double> time_;
    std::vector<Counters> counters_;
  };

  EngineTraits traits_;
  Script script_;
};

}  // namespace holdfast::internal::scenes
