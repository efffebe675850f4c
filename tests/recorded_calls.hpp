#pragma once

#include <atomic>
#include <catch2/catch.hpp>
#include <span>
#include <vector>

#include "scenes.hpp"
#include "scripted_engine.hpp"

/// What a recorder is told of a world, for tests of the loop that simulates it.
namespace holdfast::internal::scenes {

inline const Layout kOneBox = layout_of({box({1, 1, 0}, {1, 1, 1})});

/// The calls that a recorder receives.
struct Heard {
  struct Stretch {
    double begin, end;
    Vec3 acceleration;
  };
  std::vector<Stretch> steps;
  double begin = 0.0;
  int starts = 0;
  int accelerations = 0;
  std::size_t steps_before = 0;  ///< the acceleration
  int finishes = 0;
  Outcome outcome;
  Vec3 settled_position;
};

/// Stores the calls that it receives; needs no samples.
class Listener final : public Recorder {
 public:
  Heard heard;

  void start(const BoxView&, const StateView&, double time) override {
    ++heard.starts;
    heard.begin = time;
  }
  void accelerate(const StateView& settled) override {
    ++heard.accelerations;
    heard.steps_before = heard.steps.size();
    heard.settled_position = settled.position[0];
  }
  void step(const Step& step) override { heard.steps.push_back({step.begin, step.end, step.acceleration}); }
  void finish(const Outcome& outcome, const StateView&) override {
    ++heard.finishes;
    heard.outcome = outcome;
  }
};

/// Simulates one box with a recorder that stores its calls.
inline Heard listen(const Script& script, const Acceleration& acceleration, const Settings& settings) {
  const Acceleration* const accelerations[] = {&acceleration};
  WorldBatch batch = scenes::batch_of(std::span(&kOneBox, 1), accelerations, settings);
  Listener listener;
  Recorder* const recorders[] = {&listener};
  const std::atomic<bool> abort = false;
  CHECK(simulate(ScriptedEngine(script), batch, settings, recorders, abort));
  CHECK(listener.heard.starts == 1);
  CHECK(listener.heard.finishes == 1);
  return listener.heard;
}

}  // namespace holdfast::internal::scenes
