#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "validate/answers/twins.hpp"
#include "validate/cases/hard_cases.hpp"
#include "validate/laboratory/departure.hpp"

namespace holdfast::internal {

namespace {

/// Scaling a world scales its trajectory. The errors are in units of the unscaled world, m.
std::vector<Measurement> scaled_alike(Laboratory& laboratory, double factor) {
  const Scene scene = assorted_scene();
  const Snapshot end = final_state(laboratory, scene);
  Snapshot twin = final_state(laboratory, scaled_twin(scene, factor));
  double turn = 0.0;
  for (std::size_t i = 0; i < std::min(end.position.size(), twin.position.size()); ++i) {
    twin.position[i] /= factor;
    turn = std::max(turn, turn_of(end.orientation[i].conjugate() * twin.orientation[i]));
  }
  return {scaled("difference (m)", distance_between(end, twin), 0.0, 1.0, ToleranceClass::fine),
          scaled("difference of turns (rad)", turn, 0.0, 1.0, ToleranceClass::fine)};
}

/// The laws of motion have no scale of mass; scaling by a power of two changes no bit of the result.
std::vector<Measurement> heavier_alike(Laboratory& laboratory, int exponent) {
  const Scene scene = assorted_scene();
  const Snapshot end = final_state(laboratory, scene);
  const Snapshot twin = final_state(laboratory, heavier_twin(scene, std::ldexp(1.0, exponent)));
  return {verdict("same bits", same_bits(end, twin), true),
          scaled("difference (m)", distance_between(end, twin), 0.0, 1.0, ToleranceClass::exact)};
}

/// A mirrored world has the mirrored result. The bits may differ: the container extends from 0 to L, and L − x is
/// rounded differently than x.
std::vector<Measurement> mirrored_alike(Laboratory& laboratory, int axis) {
  const Scene scene = assorted_scene();
  const Snapshot end = final_state(laboratory, scene);
  Snapshot twin = final_state(laboratory, mirrored_twin(scene, axis));
  for (Vec3& position : twin.position) position[axis] = scene.settings.container.size[axis] - position[axis];
  return {scaled("difference (m)", distance_between(end, twin), 0.0, 1.0, ToleranceClass::exact)};
}

/// Exchanging x and y, or the order of the boxes, changes at most the last digits.
std::vector<Measurement> swapped_alike(Laboratory& laboratory) {
  const Scene scene = assorted_scene();
  const Snapshot end = final_state(laboratory, scene);
  Snapshot twin = final_state(laboratory, swapped_twin(scene));
  for (Vec3& position : twin.position) std::swap(position.x(), position.y());
  return {scaled("difference (m)", distance_between(end, twin), 0.0, 1.0, ToleranceClass::fine)};
}

std::vector<Measurement> reversed_alike(Laboratory& laboratory) {
  const Scene scene = assorted_scene();
  const Snapshot end = final_state(laboratory, scene);
  Snapshot twin = final_state(laboratory, reversed_twin(scene));
  std::reverse(twin.position.begin(), twin.position.end());
  return {scaled("difference (m)", distance_between(end, twin), 0.0, 1.0, ToleranceClass::fine)};
}

/// The result of a world has the same bits alone, in a batch, and when it is computed again.
std::vector<Measurement> in_company(Laboratory& laboratory) {
  const Scene scene = assorted_scene();
  Scene harder = scene;
  harder.acceleration.segments[0].acceleration *= 1.5;
  const std::vector<Scene> batch = {reversed_twin(scene), scene, harder, heavier_twin(scene, 3.0)};
  const Snapshot alone = final_state(laboratory, scene);
  const Snapshot again = final_state(laboratory, scene);
  const Snapshot together = final_states(laboratory, batch)[1];
  return {verdict("same bits again", same_bits(alone, again), true),
          verdict("same bits in a batch", same_bits(alone, together), true),
          scaled("difference (m)", distance_between(alone, together), 0.0, 1.0, ToleranceClass::exact)};
}

/// A box slides under an oblique pulse of 1.5 μg for 0.3 s and stops at a T / (μ g) = 0.45 s. From then on it is at
/// rest, and its position is the same with half the step: the pulse begins and ends at ends of steps, and the forces
/// between are constant.
std::vector<Measurement> frozen(Laboratory& laboratory) {
  constexpr double kFriction = 0.5;
  Scene scene = empty_scene({20, 20, 10}, kFriction);
  const double load = 1.5 * kFriction * scene.settings.gravity;
  scene.boxes = {standing_box({1.0, 1.0, 0.25}, {9.5, 9.5, 0.0})};
  scene.then(0.3, {load * std::sqrt(0.75), 0.5 * load, 0.0}).then(1.2, {0, 0, 0});
  Scene finer = scene;
  finer.step_factor = 0.5;
  const double moved = (final_state(laboratory, scene).position[0] - scene.boxes[0].position).norm();
  const double moved_finer = (final_state(laboratory, finer).position[0] - scene.boxes[0].position).norm();
  return {relative("displacement (m)", moved, moved_finer, ToleranceClass::good),
          scaled("displacement from 0.5 s on (m)", departure(laboratory, scene, 0.5, 1.0), 0.0, 1.0,
                 ToleranceClass::exact)};
}

}  // namespace

std::vector<Case> hard_twin_cases() {
  std::vector<Case> cases;
  for (const double factor : {0.01, 10.0, 100.0})
    cases.push_back({"hard", fmt::format("scaled_{:g}", factor), "whether a world of another size has the same motion",
                     "tolerances in metres and metres per second", true,
                     [=](Laboratory& l) { return scaled_alike(l, factor); }});
  for (const int exponent : {1, 10, 20, -20})
    cases.push_back({"hard", fmt::format("masses_2_to_{}", exponent), "whether heavier boxes have the same motion",
                     "tolerances in newton seconds", true, [=](Laboratory& l) { return heavier_alike(l, exponent); }});
  for (const int axis : {0, 1})
    cases.push_back({"hard", axis == 0 ? "mirrored_x" : "mirrored_y",
                     "whether a mirrored world has the mirrored motion",
                     "contacts solved in an order that favours one side", true,
                     [=](Laboratory& l) { return mirrored_alike(l, axis); }});
  cases.push_back({"hard", "swapped_axes", "whether a world with x and y exchanged has the same motion",
                   "axes treated differently", true, swapped_alike});
  cases.push_back({"hard", "reversed_order", "whether boxes in another order have the same motion",
                   "contacts solved one after the other, without convergence", true, reversed_alike});
  cases.push_back({"hard", "in_company", "whether a world depends on others in its batch",
                   "shared stopping criteria, data left from the previous world", true, in_company});
  cases.push_back({"hard", "frozen",
                   "whether a box is at rest after sliding, at a position that does not depend on the step",
                   "forces averaged over a step that contains the pulse's end", true, frozen});
  return cases;
}

}  // namespace holdfast::internal
