#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validate/answers/stack.hpp"
#include "validate/answers/twins.hpp"
#include "validate/cases/hard_cases.hpp"
#include "validate/laboratory/departure.hpp"

namespace holdfast::internal {

namespace {

constexpr double kMinute = 60.0;

/// Rest for a minute under a fraction of the smallest limit of a stack, with all surfaces touching exactly: a box that
/// does not move in the first step never moves. The limits are those of `stack.hpp`.
std::vector<Measurement> minute_of_rest(Laboratory& laboratory, const Stack& stack, double share) {
  Scene scene = scene_of(stack);
  const double gravity = scene.settings.gravity;
  const double limit = std::min(tipping_load(stack, gravity), sliding_load(stack, gravity));
  scene.then(kMinute, {share * limit, 0, 0});
  return rest_of(laboratory, scene);
}

/// The smallest acceleration that tips a stack: that which moves the top box by 1 mm and by 10 mm within 2 s after 0.25
/// s of rest. The expected value is that for a rigid pendulum on the lowest edge (`load_that_tips`); the stack is one
/// as long as no higher joint opens.
std::vector<Measurement> tipping_threshold(Laboratory& laboratory, const Stack& stack) {
  constexpr double kRest = 0.25;
  constexpr double kLoaded = 2.0;
  Scene scene = scene_of(stack);
  const double gravity = scene.settings.gravity;
  const double limit = tipping_load(stack, gravity);
  scene.then(kRest, {0, 0, 0});
  std::vector<Measurement> measured;
  for (const double distance : {0.001, 0.01}) {
    const double load = smallest_load_that_moves(laboratory, scene, distance, kLoaded, 0.0, 1.5 * limit, 1e-7);
    measured.push_back(relative(fmt::format("load that moves it {:g} mm (m/s2)", 1000.0 * distance), load,
                                load_that_tips(stack, gravity, distance, kLoaded), ToleranceClass::fine));
  }
  return measured;
}

/// Rest under gravity alone and then under half of the smallest limit, for boxes of very different mass.
std::vector<Measurement> uneven_rest(Laboratory& laboratory, const std::vector<double>& masses) {
  const Stack stack = {{1.0, 1.0, 0.5}, masses, 0.5};
  Scene scene = scene_of(stack);
  const double gravity = scene.settings.gravity;
  const double limit = std::min(tipping_load(stack, gravity), sliding_load(stack, gravity));
  scene.then(2.0, {0, 0, 0}).then(3.0, {0.5 * limit, 0, 0});
  return rest_of(laboratory, scene);
}

/// 20 boxes of 0.5 x 0.5 x 0.25 m: 5 m high, so that the stack tips at g l / H = 0.1 g, far below its slide limit. The
/// next higher joint would tip at 20/19 of that.
Stack tall_stack() { return even_stack(20, {0.5, 0.5, 0.25}, 0.5); }

/// 10 boxes of which the top one is 1000 times heavier. It tips at g (l/2) Σm / Σ(m z).
Stack top_heavy_stack() {
  Stack stack = even_stack(10, {1.0, 1.0, 0.25}, 0.6);
  stack.masses.back() = 1000.0;
  return stack;
}

/// The upper of two boxes overhangs by 0.9 of half its length: its centre of mass is above the lower one.
std::vector<Measurement> overhang_for_a_minute(Laboratory& laboratory) {
  Scene scene = empty_scene({20, 20, 10}, 0.5);
  const Vec3 size = {1.0, 1.0, 0.25};
  scene.boxes = {standing_box(size, {9.5, 9.5, 0}), standing_box(size, {9.5 + 0.45, 9.5, 0.25})};
  scene.then(kMinute, {0, 0, 0});
  return rest_of(laboratory, scene);
}

/// A symmetric body on several supports is at rest under gravity, and then under an acceleration of 0.2 g: below the
/// friction limit of every joint (0.5), and below the tipping limit of every block (0.5 g, with the force on its top
/// edge). The distribution of the weight over the supports is not unique and cannot be read through the engine's
/// interface; an unequal distribution is visible as a tilt or a rotation.
std::vector<Measurement> rest_of_supported(Laboratory& laboratory, const std::vector<SceneBox>& boxes) {
  Scene scene = empty_scene({20, 20, 10}, 0.5);
  scene.boxes = boxes;
  scene.then(1.0, {0, 0, 0}).then(1.0, {0.2 * scene.settings.gravity, 0, 0});
  return rest_of(laboratory, scene);
}

std::vector<Measurement> slab_on_a_row(Laboratory& laboratory) {
  std::vector<SceneBox> boxes;
  for (int i = 0; i < 5; ++i) boxes.push_back(standing_box({0.5, 0.5, 0.5}, {7.75 + i, 9.75, 0}));
  boxes.push_back(standing_box({4.5, 0.5, 0.25}, {7.75, 9.75, 0.5}));
  return rest_of_supported(laboratory, boxes);
}

std::vector<Measurement> row_on_a_slab(Laboratory& laboratory) {
  std::vector<SceneBox> boxes = {standing_box({4.5, 0.5, 0.25}, {7.75, 9.75, 0})};
  for (int i = 0; i < 5; ++i) boxes.push_back(standing_box({0.5, 0.5, 0.5}, {7.75 + i, 9.75, 0.25}));
  return rest_of_supported(laboratory, boxes);
}

std::vector<Measurement> slab_on_four(Laboratory& laboratory) {
  std::vector<SceneBox> boxes;
  for (const double x : {9.0, 10.5})
    for (const double y : {9.0, 10.5}) boxes.push_back(standing_box({0.5, 0.5, 0.5}, {x, y, 0}));
  boxes.push_back(standing_box({2.0, 2.0, 0.25}, {9.0, 9.0, 0.5}));
  return rest_of_supported(laboratory, boxes);
}

/// A slab slides over four fixed supports at 1.5 μg for 0.5 s. For every distribution of its weight, friction adds up
/// to μ m g, so that it moves by ½ (a − μg) t². Σ N y = 0 about its middle line is both the balance in roll and the
/// torque of friction in yaw: it does not rotate. It extends beyond the supports on all sides all the time.
std::vector<Measurement> slab_slides_on_four(Laboratory& laboratory) {
  constexpr double kFriction = 0.5;
  constexpr double kSeconds = 0.5;
  Scene scene = empty_scene({20, 20, 10}, kFriction);
  for (const double x : {9.5, 10.25})
    for (const double y : {9.25, 10.5}) {
      scene.boxes.push_back(standing_box({0.25, 0.25, 0.5}, {x, y, 0}));
      scene.boxes.back().mass = kFixed;
    }
  scene.boxes.push_back(standing_box({2.5, 2.0, 0.125}, {8.75, 9.0, 0.5}));
  const double excess = 0.5 * kFriction * scene.settings.gravity;
  scene.then(kSeconds, {kFriction * scene.settings.gravity + excess, 0, 0});
  const Snapshot end = final_state(laboratory, scene);
  const Vec3 moved = end.position.back() - scene.boxes.back().position;
  return {relative("displacement (m)", moved.x(), -0.5 * excess * kSeconds * kSeconds, ToleranceClass::fine),
          scaled("sideways (m)", moved.y(), 0.0, 1.0, ToleranceClass::fine),
          scaled("turn (rad)", turn_of(end.orientation.back()), 0.0, 1.0, ToleranceClass::fine)};
}

/// Three boxes that slide on each other for 0.5 s (`slipping_stack`): the top one moves by ½ (0.3 g) t², the middle one
/// by ½ (0.1 g) t², the lowest one not at all, opposite to the acceleration, for every heading.
std::vector<Measurement> slipping(Laboratory& laboratory, double heading) {
  constexpr double kSeconds = 0.5;
  Scene scene = slipping_stack();
  const double gravity = scene.settings.gravity;
  const Vec3 along = {std::cos(heading), std::sin(heading), 0.0};
  scene.then(kSeconds, 0.5 * gravity * along);
  const Snapshot end = final_state(laboratory, scene);
  const auto moved = [&](std::size_t box) { return -(end.position[box] - scene.boxes[box].position).dot(along); };
  const double path = 0.5 * gravity * kSeconds * kSeconds;
  return {relative("displacement of the top (m)", moved(2), 0.3 * path, ToleranceClass::fine),
          relative("displacement of the middle (m)", moved(1), 0.1 * path, ToleranceClass::fine),
          scaled("displacement of the lowest (m)", moved(0), 0.0, path, ToleranceClass::fine),
          scaled("turn of the top (rad)", turn_of(end.orientation[2]), 0.0, 1.0, ToleranceClass::fine)};
}

}  // namespace

std::vector<Case> hard_stack_cases() {
  const char* const creep = "boxes creep because of unconverged friction and soft contacts";
  const char* const slow =
      "impulses propagate by one box per iteration: the solver stops before the stack is in balance";
  const char* const uneven = "heavy boxes on light ones converge slowly";
  const char* const sharing = "a distribution of weight that depends on the order of the contacts";
  std::vector<Case> cases = {
      {"hard", "minute_slide_0.9", "whether a box at 0.9 of its slide limit is at rest for a minute", creep, false,
       [](Laboratory& l) {
         return minute_of_rest(l, even_stack(1, {1.0, 1.0, 0.25}, 0.5), 0.9);
       }},
      {"hard", "minute_tip_0.9", "whether a box at 0.9 of its tipping limit is at rest for a minute", creep, false,
       [](Laboratory& l) {
         return minute_of_rest(l, even_stack(1, {0.5, 0.5, 1.0}, 0.8), 0.9);
       }},
      {"hard", "minute_stack_5_0.9", "whether five boxes at 0.9 of their slide limit are at rest for a minute", slow,
       false,
       [](Laboratory& l) {
         return minute_of_rest(l, even_stack(5, {1.0, 1.0, 0.25}, 0.4), 0.9);
       }},
      {"hard", "minute_stack_20_0.9", "whether twenty boxes at 0.9 of their tipping limit are at rest for a minute",
       slow, false, [](Laboratory& l) { return minute_of_rest(l, tall_stack(), 0.9); }},
      {"hard", "minute_top_heavy_0.47", "whether a stack of ten with a top 1000 times as heavy is at rest for a minute",
       uneven, false, [](Laboratory& l) { return minute_of_rest(l, top_heavy_stack(), 0.47); }},
      {"hard", "minute_overhang_0.9", "whether a box that overhangs by 0.9 of half its length is at rest for a minute",
       creep, false, overhang_for_a_minute},
      {"hard", "stack_20_tips", "smallest acceleration that tips twenty boxes", slow, false,
       [](Laboratory& l) { return tipping_threshold(l, tall_stack()); }},
      {"hard", "top_heavy_tips", "smallest acceleration that tips ten boxes, the top one 1000 times heavier", uneven,
       false, [](Laboratory& l) { return tipping_threshold(l, top_heavy_stack()); }},
      {"hard", "slab_on_row", "whether a slab on five boxes is at rest", sharing, true, slab_on_a_row},
      {"hard", "row_on_slab", "whether five boxes on a slab are at rest", sharing, true, row_on_a_slab},
      {"hard", "slab_on_four", "whether a slab on four corners is at rest", sharing, true, slab_on_four},
      {"hard", "slab_slides_on_four", "how a slab slides over four supports", sharing, true, slab_slides_on_four},
  };
  for (const int degrees : {0, 30, 45})
    cases.push_back(
        {"hard", fmt::format("slipping_stack_{}", degrees), "how far three boxes slide on each other",
         "friction from a normal force that is not the final one; sliding along the axes of a friction pyramid", true,
         [=](Laboratory& l) { return slipping(l, degrees * std::numbers::pi / 180.0); }});
  struct Ratio {
    const char* name;
    std::vector<double> from_floor_up;
  };
  const Ratio ratios[] = {{"heavy_on_light", {1.0, 1000.0}},
                          {"light_on_heavy", {1000.0, 1.0}},
                          {"heavy_light_heavy", {1000.0, 1.0, 1000.0}},
                          {"light_heavy_light", {1.0, 1000.0, 1.0}}};
  for (const Ratio& ratio : ratios)
    cases.push_back({"hard", fmt::format("rest_{}", ratio.name),
                     "whether boxes 1000 times as heavy as their neighbours are at rest at half their limit", uneven,
                     true, [masses = ratio.from_floor_up](Laboratory& l) { return uneven_rest(l, masses); }});
  return cases;
}

}  // namespace holdfast::internal
