// What spares the native engine work must not change a bit of what comes out.

#include <algorithm>
#include <vector>

#include "core/native/native_engine.hpp"
#include "physics/measures.hpp"

namespace native_shortcuts_test {

using namespace holdfast::internal;
using namespace holdfast::internal::scenes;
using namespace holdfast::internal::physics;

namespace {

/// Accelerations that leave most loads at rest for a while, so that there is something to spare.
std::vector<Acceleration> accelerations() {
  return {acceleration_of({{0.2, Vec3::Zero()}, {0.2, Vec3(0.3 * kGravity, 0, 0)}, {0.2, Vec3::Zero()}}),
          acceleration_of({{0.3, Vec3(0.8 * kGravity, 0, 0)}, {0.2, Vec3::Zero()}}),
          acceleration_of({{0.2, Vec3(0, 0.5 * kGravity, 0)}, {0.2, Vec3(0, -0.5 * kGravity, 0)}})};
}

Settings screening_settings(bool jump, bool freeze) {
  Settings settings = at_once();
  settings.native.accuracy = Accuracy::screening;
  settings.native.jump = jump;
  settings.native.freeze = freeze;
  return settings;
}

}  // namespace

TEST_CASE("native_shortcuts: Jump and Freeze never change a bit", "[physics][native_shortcuts]") {
  const std::vector<Acceleration> all = accelerations();
  std::uint64_t skipped = 0;
  // Loads and motions differ in which boxes rest, and when.
  for (std::size_t i = 0; i < std::size(kLayouts); ++i) {
    const Acceleration& acceleration = all[i % all.size()];
    std::vector<Run> runs;
    // Both, then each taken away; without Freeze the proof of rest is repeated, and Jump still counts.
    for (const auto& [jump, freeze] : {std::pair(true, true), std::pair(false, true), std::pair(true, false)}) {
      const Settings settings = screening_settings(jump, freeze);
      runs.push_back(run(NativeEngine(settings), bundled_layout(kLayouts[i], settings), acceleration, settings));
    }
    for (std::size_t k = 1; k < runs.size(); ++k) {
      CAPTURE(kLayouts[i], &acceleration - all.data(), k);
      CHECK(same_bits(runs[k].state, runs[0].state));
      CHECK(runs[k].record.row.steps == runs[0].record.row.steps);
    }
    skipped += runs.front().record.row.steps_skipped;
  }
  CHECK(skipped > 0);
}

TEST_CASE("native_shortcuts: a world that ends by sleeping ends after half a second of rest, with and without Jump",
          "[physics][native_shortcuts]") {
  // The acceleration changes for the last time at 0.2 s; the phase of rest goes on for a minute.
  const Acceleration acceleration = acceleration_of({{0.2, Vec3(0.1 * kGravity, 0, 0)}});
  for (const bool jump : {true, false}) {
    Settings settings = screening_settings(jump, true);
    settings.stopping_condition = StoppingCondition::sleeping;
    const Run one = run(NativeEngine(settings), layout_of({box({1, 1, 0}, {1, 1, 1})}), acceleration, settings);
    CHECK(one.record.row.stop_reason == StopReason::sleeping);
    CHECK(one.record.row.end_time == Approx(0.7).margin(1.0 / 60));
  }
}

TEST_CASE("native_shortcuts: Freeze never changes a bit where boxes keep hitting others at rest",
          "[physics][native_shortcuts]") {
  // Boxes of a random scene come to rest one by one, and are hit again.
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Layout layout = random_layout(random);
    const Acceleration acceleration = random_acceleration(random, 0.25);
    std::vector<Run> runs;
    for (const bool jump : {true, false}) {
      for (const bool freeze : {true, false}) {
        Settings settings = small_container(Accuracy::standard);
        settings.native.jump = jump;
        settings.native.freeze = freeze;
        runs.push_back(run(NativeEngine(settings), layout, acceleration, settings));
      }
    }
    for (std::size_t k = 1; k < runs.size(); ++k) {
      CAPTURE(seed, k);
      CHECK(same_bits(runs[k].state, runs[0].state));
    }
  }
}

TEST_CASE("native_shortcuts: a world is the same alone and among others, in any order", "[physics][native_shortcuts]") {
  const Settings settings = screening_settings(true, true);
  std::vector<Layout> layouts;
  for (const char* name : {"seed_example", "BR5_020_layer_h60", "BR1_001_ep"})
    layouts.push_back(bundled_layout(name, settings));
  const std::vector<Acceleration> all = accelerations();
  std::vector<const Acceleration*> pointers;
  for (const Acceleration& acceleration : all) pointers.push_back(&acceleration);
  const NativeEngine engine(settings);
  const std::vector<Run> together = run_all(engine, layouts, pointers, settings);

  std::vector<Layout> backwards(layouts.rbegin(), layouts.rend());
  std::vector<const Acceleration*> pointers_backwards(pointers.rbegin(), pointers.rend());
  std::vector<Run> turned = run_all(engine, backwards, pointers_backwards, settings);
  std::reverse(turned.begin(), turned.end());

  for (std::size_t i = 0; i < together.size(); ++i) {
    const Layout& layout = layouts[i / all.size()];
    CAPTURE(layout.name, i % all.size());
    CHECK(same_bits(run(engine, layout, all[i % all.size()], settings).state, together[i].state));
    CHECK(same_bits(turned[i].state, together[i].state));
  }
  CHECK_FALSE(same_bits(together[0].state, together[1].state));
}

TEST_CASE("native_shortcuts: worlds that are advanced in turns do not feel each other", "[physics][native_shortcuts]") {
  const Settings settings = screening_settings(true, true);
  const std::vector<Layout> layouts = {bundled_layout("seed_example", settings),
                                       bundled_layout("BR5_020_layer_h60", settings)};
  const Acceleration acceleration = constant(0.8 * kGravity, 0.3);
  const Acceleration* const pointers[] = {&acceleration};
  const NativeEngine engine(settings);
  WorldBatch batch = scenes::batch_of(layouts, pointers, settings);
  const std::unique_ptr<Simulation> simulation = engine.build(batch);
  const Phase phase = phases_of(acceleration, 0.3).front();
  double time[] = {0.0, 0.0};
  while (time[0] < phase.end || time[1] < phase.end) {
    for (std::size_t world = 0; world < 2; ++world) {
      if (time[world] >= phase.end) continue;
      time[world] = scenes::advance(*simulation, world, phase);
    }
  }
  for (std::size_t world = 0; world < 2; ++world) {
    simulation->read_back(world, batch.state);
    const Run alone = run(engine, layouts[world], acceleration, settings);
    const StateView end = {alone.state.position, alone.state.orientation, alone.state.velocity,
                           alone.state.angular_velocity};
    CAPTURE(world);
    CHECK(state_hash(view(batch.state, batch.worlds[world])) == state_hash(end));
  }
}

}  // namespace native_shortcuts_test
