#pragma once

#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analyses/analysis.hpp"
#include "api/engine_loader.hpp"
#include "core/engine/series_recorder.hpp"
#include "core/engine/simulate.hpp"
#include "core/model/acceleration.hpp"
#include "core/model/layout.hpp"
#include "core/model/settings.hpp"
#include "core/model/world.hpp"

/// Scenes that several test files use, and what runs them.
namespace holdfast::internal::scenes {

inline constexpr double kGravity = 9.81;  ///< m/s², the default of the settings

/// A box of that size with its lowest corner at `corner`, m.
inline Box box(const Vec3& corner, const Vec3& size, int material = 1) { return {corner, corner + size, material, 0}; }

/// The box with a mass of its own, kg.
inline Box weighing(Box box, double mass) {
  box.mass = mass;
  return box;
}

inline Layout layout_of(std::vector<Box> boxes) { return {"layout.txt", "", "header", std::move(boxes)}; }

/// Equal boxes on top of each other, the lowest on the floor at `corner`, m.
inline Layout stack(std::size_t count, const Vec3& corner, const Vec3& size) {
  Layout layout = layout_of({});
  for (std::size_t i = 0; i < count; ++i)
    layout.boxes.push_back(box(corner + Vec3(0, 0, static_cast<double>(i) * size.z()), size));
  return layout;
}

/// Segments that follow each other: pairs of a duration, s, and an acceleration, m/s².
inline Acceleration acceleration_of(const std::vector<std::pair<double, Vec3>>& segments) {
  Acceleration acceleration{"motion.txt", "", {}};
  double time = 0.0;
  for (const auto& [duration, value] : segments) {
    acceleration.segments.push_back({time, duration, value, 0});
    time += duration;
  }
  return acceleration;
}

/// The same acceleration along x all the time, m/s².
inline Acceleration constant(double acceleration, double duration) {
  return acceleration_of({{duration, Vec3(acceleration, 0, 0)}});
}

/// Settings by which worlds begin and end with their acceleration: they neither settle nor run out.
inline Settings at_once() {
  Settings settings;
  settings.screening.settle_seconds = settings.screening.run_out_seconds = 0.0;
  return settings;
}

/// Settings with a friction coefficient between box and container, and between boxes, of `friction`; the container
/// is so large that nothing reaches a wall.
inline Settings open_floor(double friction) {
  Settings settings = at_once();
  settings.container.size = {20, 20, 10};
  settings.contact.friction_model = FrictionModel::pairs;
  settings.contact.box_box = settings.contact.box_floor = settings.contact.box_wall = friction;
  return settings;
}

/// What came of one world.
struct Run {
  StateColumns state;  ///< at the end
  std::vector<Vec3> start;
  WorldRecord record;

  /// How far box `i` went from the layout's pose, m; in double, unlike the record.
  Vec3 displacement(std::size_t i = 0) const { return state.position[i] - start[i]; }
};

/// Takes a world forward by what the engine does at once towards the end of the phase; returns the time reached, s.
inline double advance(Simulation& simulation, std::size_t world, const Phase& phase) {
  AdvanceRequest request{world, phase};
  simulation.advance({&request, 1});
  return request.reached;
}

/// The worlds of every pair.
inline WorldBatch batch_of(std::span<const Layout> layouts, std::span<const Acceleration* const> accelerations,
                           const Settings& settings) {
  std::vector<const Layout*> pointers;
  for (const Layout& layout : layouts) pointers.push_back(&layout);
  return make_batch(pointers, accelerations, settings);
}

/// Runs all worlds of `layouts` and `accelerations`; results in the batch's order.
/// @param prepare changes the state that the worlds start from
inline std::vector<Run> run_all(const Engine& engine, std::span<const Layout> layouts,
                                std::span<const Acceleration* const> accelerations, const Settings& settings,
                                const std::function<void(StateColumns&)>& prepare = {}) {
  WorldBatch batch = batch_of(layouts, accelerations, settings);
  if (prepare) prepare(batch.state);
  const std::vector<Vec3> start = batch.state.position;
  std::vector<std::unique_ptr<SeriesRecorder>> recorders;
  std::vector<Recorder*> watchers;
  for (std::size_t i = 0; i < batch.worlds.size(); ++i) {
    recorders.push_back(
        std::make_unique<SeriesRecorder>(recording_plan(settings, true, methods_of(analyses_of(settings)))));
    watchers.push_back(recorders.back().get());
  }
  const std::atomic<bool> abort = false;
  REQUIRE(simulate(engine, batch, settings, watchers, abort));

  std::vector<Run> runs;
  for (std::size_t i = 0; i < batch.worlds.size(); ++i) {
    const World& world = batch.worlds[i];
    const StateView end = view(batch.state, world);
    Run& run = runs.emplace_back();
    run.state.position.assign(end.position.begin(), end.position.end());
    run.state.orientation.assign(end.orientation.begin(), end.orientation.end());
    run.state.velocity.assign(end.velocity.begin(), end.velocity.end());
    run.state.angular_velocity.assign(end.angular_velocity.begin(), end.angular_velocity.end());
    const auto first = start.begin() + static_cast<std::ptrdiff_t>(world.box_begin);
    run.start.assign(first, first + static_cast<std::ptrdiff_t>(world.box_count));
    run.record = recorders[i]->take();
  }
  return runs;
}

/// Runs one world.
inline Run run(const Engine& engine, const Layout& layout, const Acceleration& acceleration, const Settings& settings,
               const std::function<void(StateColumns&)>& prepare = {}) {
  const Acceleration* const accelerations[] = {&acceleration};
  return std::move(run_all(engine, std::span(&layout, 1), accelerations, settings, prepare).front());
}

/// An engine of the catalogue; a failure of the test where it cannot be created.
inline std::unique_ptr<Engine> engine_of(const std::string& name, const Settings& settings) {
  Result<std::unique_ptr<Engine>> engine = make_engine(name, settings);
  if (!engine) FAIL(engine.error().message());
  return std::move(*engine);
}

inline Run run(const std::string& engine, const Layout& layout, const Acceleration& acceleration,
               const Settings& settings) {
  return run(*engine_of(engine, settings), layout, acceleration, settings);
}

}  // namespace holdfast::internal::scenes
