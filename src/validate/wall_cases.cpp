#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validate/rebound_cases.hpp"
#include "validate/track.hpp"

namespace holdfast {

namespace {

const Vec3 kContainer = {16, 8, 4};
const Vec3 kFlatBox = {1.0, 1.0, 0.5};

/// A box slides without friction at `speed` to the front wall, flat, and leaves it with the share `restitution`.
/// Newton's law at all four corners alike: v⁺ = −e v⁻, no rotation; the rest is uniform motion.
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

/// A box slides along the gap `gap` to a wall without friction under a steady braking of 0.8 g and stays there.
///   t = √(2 d / (a − μ g)),  v = √(2 d (a − μ g)); no restitution: it stops, flat
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

}  // namespace

std::vector<Case> wall_cases() {
  std::vector<Case> cases;
  for (const double restitution : {0.0, 0.25, 0.5, 0.75, 1.0})
    for (const double speed : {0.1, 0.5, 1.0, 3.0}) {
      if (speed == 0.1 && restitution != 0.5) continue;
      cases.push_back({"rebound", fmt::format("rebound_wall_e_{}_v_{}", restitution, speed),
                       fmt::format("a box meets a wall at {} m/s with restitution {}", speed, restitution),
                       speed == 0.1 ? "restitution ignored at low speed"
                                    : "contact made too early or too late; position correction adds speed",
                       speed == 1.0 || speed == 0.1,
                       [=](Laboratory& laboratory) { return wall(laboratory, restitution, speed); }});
    }
  for (const double gap : {0.1, 0.5, 2.0})
    cases.push_back({"rebound", fmt::format("braked_into_wall_gap_{}", gap),
                     fmt::format("braking at 0.8 g pushes a box along {} m to the front wall", gap),
                     "rebound, pitch, penetration", gap == 0.5,
                     [=](Laboratory& laboratory) { return braked_into_wall(laboratory, gap); }});
  return cases;
}

}  // namespace holdfast
