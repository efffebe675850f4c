#pragma once

#include <functional>

#include "core/native/native_engine.hpp"
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

}  // namespace holdfast::internal::native_scenes
