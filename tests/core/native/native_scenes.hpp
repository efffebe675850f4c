#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "core/native/native_engine.hpp"
#include "core/native/native_world.hpp"
#include "scenes.hpp"

/// What the tests of the native engine's known answers share.
namespace holdfast::internal::native_scenes {

inline const Vec3 kFlat(1.1, 1.1, 0.25);  ///< a box that slides and does not tip, m

inline Settings with(Accuracy accuracy, Settings settings) {
  settings.native.accuracy = accuracy;
  return settings;
}

inline scenes::Run native_run(const Layout& layout, const Acceleration& acceleration, const Settings& settings,
                              const std::function<void(StateColumns&)>& prepare = {}) {
  return scenes::run(NativeEngine(settings), layout, acceleration, settings, prepare);
}

inline Layout one_box(const Vec3& size, double height = 0.0) {
  return scenes::layout_of({scenes::box({10, 10, height}, size)});
}

/// A world with its own inputs.
struct OneWorld {
  Settings settings = scenes::at_once();
  Layout layout;
  Acceleration acceleration;
  const Acceleration* pointer = &acceleration;
  WorldBatch batch = scenes::batch_of(std::span(&layout, 1), std::span(&pointer, 1), settings);
  native::NativeWorld world;

  OneWorld(const Settings& given, Layout boxes, Acceleration motion,
           std::unique_ptr<native::ContactSolver> solver = native::make_contact_solver())
      : settings(given),
        layout(std::move(boxes)),
        acceleration(std::move(motion)),
        world(batch, batch.worlds.front(), settings, native::native_options(settings),
              std::make_unique<native::WorldMemory>(native::native_options(settings), std::move(solver))) {}
  OneWorld(const OneWorld&) = delete;
  OneWorld& operator=(const OneWorld&) = delete;

  /// Takes every step, and calls `look` after each.
  void run(const std::function<void()>& look = [] {}) {
    for (const Phase& phase : phases_of(acceleration, acceleration.end_time())) {
      double time = phase.begin;
      while (time < phase.end) {
        time = world.advance(phase);
        look();
      }
    }
    world.read_back(batch.state);
  }
};

}  // namespace holdfast::internal::native_scenes
