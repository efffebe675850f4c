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

/// No law of motion has a scale of mass; a power of two changes no digit.
std::vector<Measurement> heavier_alike(Laboratory& laboratory, int exponent) {
  const Scene scene = assorted_scene();
  const Snapshot end = final_state(laboratory, scene);
  const Snapshot twin = final_state(laboratory, heavier_twin(scene, std::ldexp(1.0, exponent)));
  return {verdict("same bits", same_bits(end, twin), true),
          scaled("difference (m)", distance_between(end, twin), 0.0, 1.0, ToleranceClass::exact)};
}

/// The mirror image of a world runs as the image of its run. Not bit for bit: the container spans 0 to L, and L − x
/// is rounded other than x.
std::vector<Measurement> mirrored_alike(Laboratory& laboratory, int axis) {
  const Scene scene = assorted_scene();
  const Snapshot end = final_state(laboratory, scene);
  Snapshot twin = final_state(laboratory, mirrored_twin(scene, axis));
  for (Vec3& position : twin.position) position[axis] = scene.settings.container.size[axis] - position[axis];
  return {scaled("difference (m)", distance_between(end, twin), 0.0, 1.0, ToleranceClass::exact)};
}

/// Which axis is called x, and which box comes first, changes no more than the last digits.
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

/// A world ends in the same bits whatever is computed along with it, and when it is computed again.
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

/// A box slides under an oblique pulse of 1.5 μg for 0.3 s and stops at a T / (μ g) = 0.45 s. From then on it lies
/// still, and where it lies is the same with half the step: the pulse's edges are step ends, the forces between are
/// constant.
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
    cases.push_back({"hard", fmt::format("scaled_{:g}", factor), "does a world of another size move alike",
                     "tolerances in metres and metres a second", true,
                     [=](Laboratory& l) { return scaled_alike(l, factor); }});
  for (const int exponent : {1, 10, 20, -20})
    cases.push_back({"hard", fmt::format("masses_2_to_{}", exponent), "do heavier boxes move alike",
                     "tolerances in newton seconds", true, [=](Laboratory& l) { return heavier_alike(l, exponent); }});
  for (const int axis : {0, 1})
    cases.push_back({"hard", axis == 0 ? "mirrored_x" : "mirrored_y", "does a mirrored world move alike",
                     "contacts solved in an order that favours a side", true,
                     [=](Laboratory& l) { return mirrored_alike(l, axis); }});
  cases.push_back({"hard", "swapped_axes", "does a world with x and y exchanged move alike", "axes treated differently",
                   true, swapped_alike});
  cases.push_back({"hard", "reversed_order", "do boxes in another order move alike",
                   "contacts solved one after the other, not to the end", true, reversed_alike});
  cases.push_back({"hard", "in_company", "does a world depend on those computed along with it",
                   "shared stopping tests, leftovers of the last world", true, in_company});
  cases.push_back({"hard", "frozen", "does a box lie still after a slip, in a place that does not depend on the step",
                   "forces spread over steps across the pulse's end", true, frozen});
  return cases;
}

}  // namespace holdfast::internal
