#include <fmt/format.h>

#include "validate/case.hpp"

namespace holdfast {

namespace {

/// A flat box under a constant acceleration of 1.5 μg along x for a second. Sliding against the acceleration with
/// a − μg, it has gone −½ (a − μg) t².
std::vector<Measurement> slide_path(Laboratory& laboratory) {
  const double friction = 0.5;
  Scene scene = empty_scene({20, 20, 10}, friction);
  const double gravity = scene.settings.gravity;
  scene.boxes.push_back(standing_box({1.0, 1.0, 0.2}, {15, 9.5, 0}));
  const double excess = 0.5 * friction * gravity;
  scene.then(1.0, {friction * gravity + excess, 0, 0});
  const Snapshot end = final_state(laboratory, scene);
  const double moved = end.position[0].x() - scene.boxes[0].position.x();
  return {relative("displacement (m)", moved, -0.5 * excess, ToleranceClass::fine),
          relative("velocity (m/s)", end.velocity[0].x(), -excess, ToleranceClass::fine)};
}

}  // namespace

std::vector<Case> slide_cases() {
  return {{"slide", "slide_path", "how far and how fast a box slides at 1.5 times its limit",
           "first-order time stepping lengthens the path by the factor 1 + h/t", true, slide_path}};
}

}  // namespace holdfast
