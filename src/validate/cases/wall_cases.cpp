#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validate/cases/rebound_cases.hpp"
#include "validate/laboratory/track.hpp"

namespace holdfast::internal {

namespace {

const Vec3 kContainer = {16, 8, 4};
const Vec3 kFlatBox = {1.0, 1.0, 0.5};

/// A box slides without friction at `speed` to the front wall, with its face parallel to the wall, and rebounds.
/// Newton's law is the same at all four corners: v⁺ = −e v⁻, no rotation; the remaining motion is uniform.
std::vector<Measurement> wall(Laboratory& laboratory, double restitution, double speed) {
  const double gap = 0.2137;
  const double after = 0.31;
  Scene scene = empty_scene(kContainer, 0.0, restitution);
  scene.boxes.push_back(standing_box(kFlatBox, {gap, 3.5, 0}));
  scene.boxes[0].velocity = {-speed, 0, 0};
  scene.then(gap / speed + after, Vec3::Zero());
  const Track track = track_of(laboratory, scene);
  const Snapshot& end = track.back();
  const double energy = kinetic_energy(scene, track.front());
  const double place = end.position[0].x() - 0.5 * kFlatBox.x();
  using enum ToleranceClass;
  return {scaled("speed after (m/s)", end.velocity[0].x(), restitution * speed, speed, fine),
          scaled("energy after (share)", kinetic_energy(scene, end) / energy, restitution * restitution, 1.0, fine),
          scaled("distance from wall (m)", place, restitution * speed * after, gap, fine),
          scaled("turn (rad)", turn_of(end.orientation[0]), 0.0, 1.0, fine),
          scaled("energy gained (share)", energy_gain(scene, track) / energy, 0.0, 1.0, fine)};
}

/// A box slides over the distance `gap` to a frictionless wall under constant braking of 0.8 g and stays there.
///   t = √(2 d / (a − μ g)),  v = √(2 d (a − μ g)); without restitution it stops, parallel to the wall
std::vector<Measurement> braked_into_wall(Laboratory& laboratory, double gap) {
  const double friction = 0.3;
  Scene scene = scene_of_pairs(kContainer, friction, friction, 0.0);
  const double gravity = scene.settings.gravity;
  const double excess = (0.8 - friction) * gravity;
  const double time = std::sqrt(2.0 * gap / excess);
  const double speed = std::sqrt(2.0 * gap * excess);
  scene.boxes.push_back(standing_box(kFlatBox, {gap, 3.5, 0}));
  scene.then(time + 0.5, {0.8 * gravity, 0, 0});
  const Track track = track_of(laboratory, scene);
  const Arrival arrival = arrival_of(
      track, [](const Snapshot& s) { return s.position[0].x() - 0.5 * kFlatBox.x(); },
      [](const Snapshot& s) { return -s.velocity[0].x(); }, excess);
  const Snapshot& end = track.back();
  const double energy = 0.5 * speed * speed * scene.batch().boxes.mass[0];
  double deepest = 0.0;
  for (const Snapshot& state : track) deepest = std::max(deepest, 0.5 * kFlatBox.x() - state.position[0].x());
  using enum ToleranceClass;
  return {relative("time to wall (s)", arrival.time, time, fine),
          relative("speed at wall (m/s)", arrival.speed, speed, fine),
          scaled("penetration (m)", deepest, 0.0, gap, fine),
          scaled("distance from wall at the end (m)", end.position[0].x() - 0.5 * kFlatBox.x(), 0.0, gap, fine),
          scaled("speed left (m/s)", end.velocity[0].norm(), 0.0, speed, exact),
          scaled("turn (rad)", turn_of(end.orientation[0]), 0.0, 1.0, fine),
          scaled("energy gained (share)", energy_gain(scene, track) / energy, 0.0, 1.0, fine)};
}

/// A side of the container, by the axis perpendicular to it and the end of that axis.
struct Wall {
  const char* name;
  int axis;
  bool far;
};
constexpr Wall kWalls[] = {{"floor", 2, false}, {"front", 0, false}, {"rear", 0, true},
                           {"left", 1, false},  {"right", 1, true},  {"roof", 2, true}};

/// A box without friction moves to a side of the container, 5 cm away, and comes to rest there: it has moved by exactly
/// 5 cm. The effective gravity has 0.5 m/s² towards the side; for floor and roof that replaces gravity, for the other
/// sides gravity also acts, downwards.
std::vector<Measurement> wall_in_place(Laboratory& laboratory, const Wall& wall) {
  constexpr double kGap = 0.05;
  constexpr double kPush = 0.5;  // m/s²
  Scene scene = empty_scene(kContainer, 0.0);
  SceneBox box = standing_box(kFlatBox, {3, 3, 0});
  const double half = 0.5 * kFlatBox[wall.axis];
  box.position[wall.axis] = wall.far ? kContainer[wall.axis] - half - kGap : half + kGap;
  scene.boxes.push_back(box);
  Vec3 acceleration = Vec3::Zero();
  // The boxes feel g − a: the sign of the wanted acceleration along the axis is reversed.
  const double felt = wall.far ? kPush : -kPush;
  acceleration[wall.axis] = wall.axis == 2 ? -scene.settings.gravity - felt : -felt;
  scene.then(2.0, acceleration);
  const Snapshot end = final_state(laboratory, scene);
  const double gone = std::abs(end.position[0][wall.axis] - box.position[wall.axis]);
  return {scaled("distance to the wall (m)", gone, kGap, 1.0, ToleranceClass::fine)};
}

}  // namespace

std::vector<Case> wall_cases() {
  std::vector<Case> cases;
  for (const double restitution : {0.0, 0.25, 0.5, 0.75, 1.0})
    for (const double speed : {0.1, 0.5, 1.0, 3.0}) {
      if (speed == 0.1 && restitution != 0.5) continue;
      cases.push_back({"rebound", fmt::format("rebound_wall_e_{}_v_{}", restitution, speed),
                       fmt::format("a box hits a wall at {} m/s with restitution {}", speed, restitution),
                       speed == 0.1 ? "restitution ignored at low speed"
                                    : "contact too early or too late; position correction adds speed",
                       speed == 1.0 || speed == 0.1,
                       [=](Laboratory& laboratory) { return wall(laboratory, restitution, speed); }});
    }
  for (const double gap : {0.1, 0.5, 2.0})
    cases.push_back({"rebound", fmt::format("braked_into_wall_gap_{}", gap),
                     fmt::format("braking at 0.8 g pushes a box along {} m to the front wall", gap),
                     "rebound, pitch, penetration", gap == 0.5,
                     [=](Laboratory& laboratory) { return braked_into_wall(laboratory, gap); }});
  for (const Wall& wall : kWalls)
    cases.push_back({"rebound", fmt::format("wall_in_place_{}", wall.name),
                     fmt::format("where a box comes to rest that is lightly pressed against the {}", wall.name),
                     "a wall at a wrong position, a contact at a distance or only at a penetration", true,
                     [wall](Laboratory& laboratory) { return wall_in_place(laboratory, wall); }});
  return cases;
}

}  // namespace holdfast::internal
