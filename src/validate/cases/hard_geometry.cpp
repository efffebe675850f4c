#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validate/answers/dominoes.hpp"
#include "validate/answers/stack.hpp"
#include "validate/cases/hard_cases.hpp"
#include "validate/laboratory/departure.hpp"

namespace holdfast::internal {

namespace {

/// A box between two side walls, with the gap on each side, under `share` of its sliding limit along them for 2 s.
/// Nothing presses it against a wall, so it slides as if free: −½ (a − μg) t². Without gap, states in which the box is
/// wedged between the walls also satisfy the contact laws; they need a pre-stress that nothing causes.
std::vector<Measurement> snug_channel(Laboratory& laboratory, double gap, double share) {
  constexpr double kFriction = 0.5;
  constexpr double kSeconds = 2.0;
  Scene scene = empty_scene({20.0, 1.0 + 2.0 * gap, 10.0}, kFriction);
  const double limit = kFriction * scene.settings.gravity;
  scene.boxes = {standing_box({1.0, 1.0, 0.25}, {15.0, gap, 0.0})};
  scene.then(kSeconds, {share * limit, 0, 0});
  const Snapshot end = final_state(laboratory, scene);
  const double moved = end.position[0].x() - scene.boxes[0].position.x();
  return {
      relative("displacement (m)", moved, -0.5 * (share - 1.0) * limit * kSeconds * kSeconds, ToleranceClass::good)};
}

/// A gap between neighbours of a stack, m; negative: they overlap.
struct Joint {
  const char* name;
  double gap;
};

/// Whether a box of the scene rotates by 10°.
bool topples(Laboratory& laboratory, const Scene& scene) {
  constexpr double kTen = 0.174532925199432958;
  return std::isfinite(time_to_reach(laboratory, scene, kTen, [](const StateView& state) {
    double turn = 0.0;
    for (const Rotation& orientation : state.orientation) turn = std::max(turn, turn_of(orientation));
    return turn;
  }));
}

/// Three cubes with a gap or an overlap at every joint and at the floor. They land without rebound, are at rest after a
/// second, and never move upwards. Then they stand at 0.95 and topple at 1.05 of g l / H, as without gaps.
std::vector<Measurement> joined_stack(Laboratory& laboratory, double gap) {
  const Stack stack = even_stack(3, {0.5, 0.5, 0.5}, 0.5);
  Scene scene = scene_of(stack);
  const double gravity = scene.settings.gravity;
  const double limit = tipping_load(stack, gravity);
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) scene.boxes[i].position.z() += gap * static_cast<double>(i + 1);
  scene.then(1.0, {0, 0, 0});

  double upwards = 0.0;
  double energy = std::numeric_limits<double>::infinity();
  laboratory.run(scene, [&](const Moment& moment) {
    energy = 0.0;
    for (const Vec3& velocity : moment.state.velocity) {
      upwards = std::max(upwards, velocity.z());
      energy += 0.5 * velocity.squaredNorm();
    }
    return true;
  });
  const double scale = gravity * stack.box_size.z();
  Scene below = scene;
  below.then(3.0, {0.95 * limit, 0, 0});
  Scene above = scene;
  above.then(3.0, {1.05 * limit, 0, 0});
  return {scaled("kinetic energy after 1 s (J/kg)", energy, 0.0, scale, ToleranceClass::exact),
          scaled("largest speed upwards (m/s)", upwards, 0.0, std::sqrt(scale), ToleranceClass::fine),
          verdict("topples at 0.95 of its limit", topples(laboratory, below), false),
          verdict("topples at 1.05 of its limit", topples(laboratory, above), true)};
}

/// A plate of 1 m x 1 m x 1 mm slides at μg like any box. At 1.5 μg it moves by ½ (a − μg) t²; the smallest
/// acceleration that moves it by d = 1 mm within t = 2 s is μg + 2 d / t².
std::vector<Measurement> thin_plate(Laboratory& laboratory) {
  constexpr double kFriction = 0.5;
  constexpr double kSeconds = 1.0;
  Scene scene = empty_scene({20, 20, 10}, kFriction);
  const double limit = kFriction * scene.settings.gravity;
  scene.boxes = {standing_box({1.0, 1.0, 0.001}, {15.0, 9.5, 0.0})};
  Scene loaded = scene;
  loaded.then(kSeconds, {1.5 * limit, 0, 0});
  const Snapshot end = final_state(laboratory, loaded);

  constexpr double kDistance = 0.001;
  constexpr double kWithin = 2.0;
  scene.then(0.25, {0, 0, 0});
  const double load = smallest_load_that_moves(laboratory, scene, kDistance, kWithin, 0.0, 1.5 * limit, 1e-7);
  return {relative("displacement (m)", end.position[0].x() - scene.boxes[0].position.x(),
                   -0.25 * limit * kSeconds * kSeconds, ToleranceClass::fine),
          scaled("turn (rad)", turn_of(end.orientation[0]), 0.0, 1.0, ToleranceClass::fine),
          relative("load that moves it 1 mm (m/s2)", load, limit + 2.0 * kDistance / (kWithin * kWithin),
                   ToleranceClass::fine)};
}

/// A square plate that spins flat on the floor. With the weight on four corners at s/√2 from its middle, the torque of
/// friction is μ m g s/√2 for every distribution over the corners; with I = m s²/6 the angular velocity decreases at
/// the rate 6 μ g / (√2 s). It is half after ω / (2 rate) and zero after an angle of ω² / (2 rate). This is the model
/// of all engines here. Uniform pressure gives 0.3826 instead of 0.7071 μ m g s: a real plate spins 1.85 times as long.
/// (The mean distance from the middle of a square is s (√2 + asinh 1) / 6 = 0.3826 s.)
std::vector<Measurement> spinning_plate(Laboratory& laboratory) {
  constexpr double kFriction = 0.5;
  constexpr double kSpin = 10.0;
  Scene scene = empty_scene({20, 20, 10}, kFriction);
  scene.boxes = {standing_box({1.0, 1.0, 0.125}, {9.5, 9.5, 0.0})};
  scene.boxes[0].angular_velocity = {0, 0, kSpin};
  scene.then(1.0, {0, 0, 0});
  const double rate = 6.0 * kFriction * scene.settings.gravity / (std::sqrt(2.0) * scene.boxes[0].size.x());
  const double half = time_to_reach(laboratory, scene, 0.5 * kSpin,
                                    [](const StateView& state) { return kSpin - state.angular_velocity[0].z(); });
  const Snapshot end = final_state(laboratory, scene);
  return {
      relative("time to half the spin (s)", half, 0.5 * kSpin / rate, ToleranceClass::fine),
      relative("angle at the stop (rad)", turn_of(end.orientation[0]), 0.5 * kSpin * kSpin / rate,
               ToleranceClass::fine),
      scaled("displacement (m)", (end.position[0] - scene.boxes[0].position).norm(), 0.0, 1.0, ToleranceClass::fine)};
}

/// A box slides on one edge in front of its centre of mass, with the diagonal at φ from the vertical, tanφ = ½.
/// A normal force N would accelerate the edge by (N/m)(1 + 3 (sin²φ − μ sinφ cosφ)): downwards, into the floor, for
/// μ > (1/3 + sin²φ) / (sinφ cosφ), which has its minimum, 4/3, at this φ. At μ = 2 there is no solution with finite
/// forces (Painlevé 1895), but with impulses. In any case, friction and contacts without rebound never add energy.
std::vector<Measurement> painleve(Laboratory& laboratory) {
  constexpr double kFriction = 2.0;
  constexpr double kTilt = 0.1;
  constexpr double kAllowed = 1.01;
  Scene scene = empty_scene({40, 20, 10}, kFriction);
  const double gravity = scene.settings.gravity;
  const double height = 1.0;
  const double length = height * std::tan(std::atan(0.5) + kTilt);
  SceneBox box;
  box.size = {length, 1.0, height};
  box.mass = 1.0;
  box.orientation = Rotation(Eigen::AngleAxisd(kTilt, Vec3::UnitY()));
  const Vec3 edge_from_centre = box.orientation * Vec3(0.5 * length, 0.0, -0.5 * height);
  box.position = {5.0, 10.0, -edge_from_centre.z()};
  box.velocity = {2.0, 0.0, 0.0};
  scene.boxes = {box};
  scene.then(3.0, {0, 0, 0});

  const Vec3 square = box.size.cwiseProduct(box.size);
  const Vec3 inertia = Vec3(square.y() + square.z(), square.z() + square.x(), square.x() + square.y()) / 12.0;
  double first = 0.0;
  double largest = 0.0;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    const Vec3 spin = moment.state.orientation[0].conjugate() * moment.state.angular_velocity[0];
    const double energy = 0.5 * moment.state.velocity[0].squaredNorm() + 0.5 * spin.dot(inertia.cwiseProduct(spin)) +
                          gravity * moment.state.position[0].z();
    if (moment.time == 0.0) first = energy;
    largest = std::max(largest, energy);
    return true;
  });
  return {verdict("stays finite", outcome.stop_reason != StopReason::failed, true),
          verdict("gains energy", !(largest <= kAllowed * first), false)};
}

/// The same row of dominoes in two sizes, 4 : 1. Only gravity sets a time scale, so that the front is √4 times as fast
/// in the larger row; both use the engine's own step.
std::vector<Measurement> domino_scale(Laboratory& laboratory) {
  return {relative("ratio of the fronts' speeds", domino_speed(laboratory, 1.0) / domino_speed(laboratory, 0.25), 2.0,
                   ToleranceClass::coarse)};
}

}  // namespace

std::vector<Case> hard_geometry_cases() {
  std::vector<Case> cases;
  for (const Joint& joint : {Joint{"0", 0.0}, Joint{"1um", 1e-6}, Joint{"1mm", 1e-3}})
    for (const double share : {1.001, 1.1, 1.5})
      cases.push_back({"hard", fmt::format("snug_channel_gap_{}_at_{:g}", joint.name, share),
                       "how far a box slides between two walls without clearance",
                       "the box is wedged between the walls by forces that nothing causes", true,
                       [=](Laboratory& l) { return snug_channel(l, joint.gap, share); }});
  for (const Joint& joint :
       {Joint{"touching", 0.0}, Joint{"gap_1um", 1e-6}, Joint{"overlap_1um", -1e-6}, Joint{"gap_1mm", 1e-3}})
    cases.push_back({"hard", fmt::format("stack_3_{}", joint.name),
                     "whether a stack with gaps or overlaps settles without a jump and then stands as without",
                     "the correction of overlaps adds velocity, and the boxes jump", true,
                     [=](Laboratory& l) { return joined_stack(l, joint.gap); }});
  cases.push_back(
      {"hard", "thin_plate", "how a plate of 1 mm slides", "moments of inertia in a ratio of 1e6", false, thin_plate});
  cases.push_back({"hard", "spinning_plate", "how long a square plate spins on four corners",
                   "a torque of friction that depends on the distribution of weight over the corners", true,
                   spinning_plate});
  cases.push_back({"hard", "painleve", "whether a box that slides on its edge with friction 2 gains energy",
                   "division by an effective mass that is not positive", true, painleve});
  cases.push_back({"hard", "domino_scale", "how much faster the front is in dominoes four times as large",
                   "tolerances in metres, and steps that are coarse for small boxes", false, domino_scale});
  return cases;
}

}  // namespace holdfast::internal
