#include <algorithm>
#include <catch2/catch.hpp>

#include "validate/laboratory/departure.hpp"
#include "validate/laboratory/laboratory.hpp"

namespace laboratory_batch_test {

using namespace holdfast::internal;

namespace {

/// Moves every box with its velocity in steps of 1/steps_per_second: enough to test the observers.
class Drifting final : public Engine {
 public:
  explicit Drifting(double step) : step_(step) { traits_.name = "drifting"; }
  const EngineTraits& traits() const override { return traits_; }
  std::unique_ptr<Simulation> build(const WorldBatch& batch) const override {
    return std::make_unique<Drift>(batch, step_);
  }

 private:
  class Drift final : public SteppedSimulation {
   public:
    Drift(const WorldBatch& batch, double step)
        : worlds_(batch.worlds), state_(batch.state), time_(batch.worlds.size(), 0.0), step_(step) {}
    double step(std::size_t world, const Phase& phase) override {
      const double end = std::min(time_[world] + step_, phase.end);
      const World& range = worlds_[world];
      for (std::size_t i = range.box_begin; i < range.box_begin + range.box_count; ++i)
        state_.position[i] += (end - time_[world]) * state_.velocity[i];
      return time_[world] = end;
    }
    void read_back(std::size_t world, StateColumns& state) const override {
      const World& range = worlds_[world];
      for (std::size_t i = range.box_begin; i < range.box_begin + range.box_count; ++i)
        state.position[i] = state_.position[i];
    }
    Counters counters(std::size_t /*world*/) const override { return {}; }

   private:
    std::vector<World> worlds_;
    StateColumns state_;
    std::vector<double> time_;
    double step_;
  };
  EngineTraits traits_;
  double step_;
};

const EngineSetting kSetting = {"drifting", "4 Hz", [](Settings& settings) { settings.steps_per_second = 4.0; }};

Result<std::unique_ptr<Engine>> make_drifting(const std::string& /*name*/, const Settings& settings) {
  return std::unique_ptr<Engine>(std::make_unique<Drifting>(1.0 / settings.steps_per_second.value()));
}

Scene drifting_scene(double speed) {
  Scene scene = empty_scene({10, 10, 10}, 0.5);
  scene.boxes = {standing_box({1, 1, 1}, {1, 1, 0})};
  scene.boxes[0].velocity = {speed, 0, 0};
  return scene.then(2.0, {0, 0, 0});
}

}  // namespace

TEST_CASE("laboratory: every scene of a batch ends in its own state", "[validate][laboratory]") {
  const std::atomic<bool> abort = false;
  Laboratory laboratory(make_drifting, kSetting, abort);
  const std::vector<Scene> scenes = {drifting_scene(1.0), drifting_scene(0.5)};
  const std::vector<Snapshot> ends = final_states(laboratory, scenes);
  REQUIRE(ends.size() == 2);
  CHECK(ends[0].time == 2.0);
  CHECK(ends[0].position[0].x() == 3.5);
  CHECK(ends[1].position[0].x() == 2.5);
  CHECK(laboratory.cost().box_seconds == 4.0);
}

TEST_CASE("laboratory: an observer that has finished does not end the others", "[validate][laboratory]") {
  const std::atomic<bool> abort = false;
  Laboratory laboratory(make_drifting, kSetting, abort);
  const std::vector<Scene> scenes = {drifting_scene(1.0), drifting_scene(0.5)};
  int first = 0;
  int second = 0;
  const std::vector<Observer> observers = {[&](const Moment&) { return ++first < 3; },
                                           [&](const Moment&) { return ++second > 0; }};
  laboratory.run(scenes, observers);
  CHECK(first == 3);
  CHECK(second == 9);
}

TEST_CASE("laboratory: a scene's step factor multiplies the step", "[validate][laboratory]") {
  const std::atomic<bool> abort = false;
  Laboratory laboratory(make_drifting, kSetting, abort);
  Scene scene = drifting_scene(1.0);
  scene.step_factor = 2.0;
  int moments = 0;
  laboratory.run(scene, [&](const Moment&) { return ++moments > 0; });
  CHECK(moments == 5);
}

TEST_CASE("departure: counts from a given time on and ends once it is large enough", "[validate][departure]") {
  const std::atomic<bool> abort = false;
  Laboratory laboratory(make_drifting, kSetting, abort);
  CHECK(departure(laboratory, drifting_scene(1.0), 1.5, 10.0) == Approx(0.5));
  CHECK(departure(laboratory, drifting_scene(1.0), 0.0, 0.6) == Approx(0.75));
}

}  // namespace laboratory_batch_test
