#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validate/cases/rebound_cases.hpp"
#include "validate/laboratory/track.hpp"

namespace holdfast::internal {

namespace {

using enum ToleranceClass;

const Vec3 kContainer = {16, 8, 4};
const Vec3 kFlatBox = {1.0, 1.0, 0.5};

SceneBox flat_box(double x_min, double mass, double speed) {
  SceneBox box = standing_box(kFlatBox, {x_min, 3.5, 0});
  box.mass = mass;
  box.velocity = {speed, 0, 0};
  return box;
}

/// Velocities after a collision of two masses, the second one at rest before. Momentum is conserved, and Newton's law
/// of restitution holds, v₂⁺ − v₁⁺ = e v₁:
///   v₁⁺ = (m₁ − e m₂) v / (m₁ + m₂),  v₂⁺ = (1 + e) m₁ v / (m₁ + m₂)
struct Meeting {
  double first;
  double second;
};
Meeting meet(double first_mass, double second_mass, double restitution, double speed) {
  const double total = first_mass + second_mass;
  return {(first_mass - restitution * second_mass) * speed / total, (1.0 + restitution) * first_mass * speed / total};
}

/// A box slides without friction against one at rest. Energy lost: ½ m₁ m₂ / (m₁ + m₂) (1 − e²) v².
std::vector<Measurement> pair(Laboratory& laboratory, double restitution, double first_mass, double second_mass) {
  const double speed = 1.0;
  Scene scene = empty_scene(kContainer, 0.0, restitution);
  scene.boxes = {flat_box(4.0, first_mass, speed), flat_box(5.2137, second_mass, 0.0)};
  scene.then(0.7, Vec3::Zero());
  const Track track = track_of(laboratory, scene);
  const Snapshot& end = track.back();
  const Meeting after = meet(first_mass, second_mass, restitution, speed);
  const double momentum = first_mass * speed;
  const double energy = kinetic_energy(scene, track.front());
  const double reduced = first_mass * second_mass / (first_mass + second_mass);
  const double lost = 0.5 * reduced * (1.0 - restitution * restitution) * speed * speed;
  const double momentum_after = first_mass * end.velocity[0].x() + second_mass * end.velocity[1].x();
  return {scaled("speed of the first after (m/s)", end.velocity[0].x(), after.first, speed, fine),
          scaled("speed of the second after (m/s)", end.velocity[1].x(), after.second, speed, fine),
          scaled("momentum after (kg m/s)", momentum_after, momentum, momentum, exact),
          scaled("energy lost (J)", energy - kinetic_energy(scene, end), lost, energy, fine),
          scaled("turn (rad)", turn_of(end.orientation[0]) + turn_of(end.orientation[1]), 0.0, 1.0, fine),
          scaled("energy gained (share)", energy_gain(scene, track) / energy, 0.0, 1.0, fine)};
}

/// Two boxes with different surfaces collide: the smaller coefficient of restitution applies, and between a box and the
/// container that of the box.
std::vector<Measurement> mixed_surfaces(Laboratory& laboratory) {
  Scene scene = empty_scene(kContainer, 0.0, 0.25);
  scene.boxes = {flat_box(4.0, 100, 1.0), flat_box(5.2137, 100, 0.0)};
  scene.boxes[0].restitution = 1.0;
  scene.boxes[1].restitution = 0.5;
  scene.then(0.7, Vec3::Zero());
  const Snapshot end = final_state(laboratory, scene);
  const Meeting after = meet(100, 100, 0.5, 1.0);
  return {scaled("speed of the first after (m/s)", end.velocity[0].x(), after.first, 1.0, fine),
          scaled("speed of the second after (m/s)", end.velocity[1].x(), after.second, 1.0, fine)};
}

/// A box sliding at 3 m/s with friction 0.3 hits one at rest after 0.4 m; both slide on until friction stops them, each
/// by a further v²/(2 μ g). The vertical faces are without friction, so that no vertical force acts between them.
std::vector<Measurement> sliding_pair(Laboratory& laboratory, double restitution, double first_mass,
                                      double second_mass) {
  const double friction = 0.3;
  const double gap = 0.4;
  Scene scene = scene_of_pairs(kContainer, friction, 0.0, friction, restitution);
  const double deceleration = friction * scene.settings.gravity;
  scene.boxes = {flat_box(4.0, first_mass, 3.0), flat_box(5.0 + gap, second_mass, 0.0)};
  scene.then(2.0, Vec3::Zero());
  const Meeting after = meet(first_mass, second_mass, restitution, std::sqrt(9.0 - 2.0 * deceleration * gap));
  const Track track = track_of(laboratory, scene);
  const Snapshot& end = track.back();
  const auto moved = [&](std::size_t i) { return end.position[i].x() - scene.boxes[i].position.x(); };
  const double first = gap + 0.5 * after.first * after.first / deceleration;
  const double second = 0.5 * after.second * after.second / deceleration;
  const double energy = kinetic_energy(scene, track.front());
  return {relative("displacement of the first (m)", moved(0), first, fine),
          relative("displacement of the second (m)", moved(1), second, fine),
          scaled("speed left (m/s)", end.velocity[0].norm() + end.velocity[1].norm(), 0.0, 3.0, exact),
          scaled("energy gained (share)", energy_gain(scene, track) / energy, 0.0, 1.0, fine)};
}

/// Three equal boxes in a row with gaps, the first one sliding: Newton's cradle. Collisions one after the other:
///   v₁ = (1 − e)/2 v,  v₂ = (1 + e)/2 (1 − e)/2 v,  v₃ = ((1 + e)/2)² v
/// until the first one reaches the second again, long after the end.
std::vector<Measurement> cradle(Laboratory& laboratory, double restitution) {
  const double speed = 2.0;
  Scene scene = empty_scene(kContainer, 0.0, restitution);
  scene.boxes = {flat_box(4.0, 100, speed), flat_box(5.1037, 100, 0.0), flat_box(6.2137, 100, 0.0)};
  scene.then(0.2, Vec3::Zero());
  const Track track = track_of(laboratory, scene);
  const Snapshot& end = track.back();
  const double passed = 0.5 * (1.0 + restitution);
  const double kept = 0.5 * (1.0 - restitution);
  const double energy = kinetic_energy(scene, track.front());
  return {scaled("speed of the first after (m/s)", end.velocity[0].x(), kept * speed, speed, fine),
          scaled("speed of the second after (m/s)", end.velocity[1].x(), passed * kept * speed, speed, fine),
          scaled("speed of the third after (m/s)", end.velocity[2].x(), passed * passed * speed, speed, fine),
          scaled("energy gained (share)", energy_gain(scene, track) / energy, 0.0, 1.0, fine)};
}

/// Two boxes hit a third one between them at the same time from both sides. By symmetry the middle one stays; each
/// outer one leaves with −e v by the law of restitution at its face.
std::vector<Measurement> from_both_sides(Laboratory& laboratory, double restitution) {
  const double speed = 1.0;
  const double gap = 0.25;  // binary fractions: the scene is symmetric to the last bit
  Scene scene = empty_scene(kContainer, 0.0, restitution);
  scene.boxes = {flat_box(6.5 - gap, 100, speed), flat_box(7.5, 100, 0.0), flat_box(8.5 + gap, 100, -speed)};
  scene.then(0.5, Vec3::Zero());
  const Track track = track_of(laboratory, scene);
  const Snapshot& end = track.back();
  const double energy = kinetic_energy(scene, track.front());
  return {scaled("speed of the middle one (m/s)", end.velocity[1].norm(), 0.0, speed, exact),
          scaled("speeds' sum (m/s)", end.velocity[0].x() + end.velocity[2].x(), 0.0, speed, exact),
          scaled("speed of the first after (m/s)", end.velocity[0].x(), -restitution * speed, speed, fine),
          scaled("energy gained (share)", energy_gain(scene, track) / energy, 0.0, 1.0, fine)};
}

}  // namespace

std::vector<Case> meeting_cases() {
  std::vector<Case> cases;
  const auto add = [&](std::string name, std::string question, const char* failure_mode, bool quick, auto measure) {
    cases.push_back({"rebound", std::move(name), std::move(question), failure_mode, quick, measure});
  };
  struct Masses {
    double first;
    double second;
    const char* name;
  };
  for (const double e : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    for (const Masses m : {Masses{100, 100, "1_1"}, Masses{100, 300, "1_3"}, Masses{300, 100, "3_1"}})
      add(fmt::format("rebound_pair_e_{}_masses_{}", e, m.name),
          fmt::format("a box hits one at rest with restitution {}, masses {}", e, m.name),
          "momentum lost between bodies, restitution too high", e == 0.0 || e == 0.5,
          [=](Laboratory& laboratory) { return pair(laboratory, e, m.first, m.second); });
  }
  add("rebound_pair_mixed_surfaces", "boxes with restitution 1 and 0.5 collide",
      "the product or mean of both coefficients", true, mixed_surfaces);
  for (const double e : {0.0, 0.5, 1.0})
    add(fmt::format("both_sides_e_{}", e), "two boxes hit a third one from both sides at once",
        "the order of contacts breaks the symmetry", e == 0.5,
        [=](Laboratory& laboratory) { return from_both_sides(laboratory, e); });
  for (const double e : {0.5, 1.0})
    add(fmt::format("cradle_e_{}", e), "a collision propagates through a row of three boxes with gaps",
        "two collisions in a step treated as one", e == 1.0,
        [=](Laboratory& laboratory) { return cradle(laboratory, e); });
  for (const double e : {0.0, 0.5, 1.0})
    add(fmt::format("sliding_pair_e_{}", e), "where a sliding box and the box at rest that it hits stop",
        "friction during the collision, late contact", e == 0.0,
        [=](Laboratory& laboratory) { return sliding_pair(laboratory, e, 100, 100); });
  add("sliding_pair_e_0_masses_3_1", "where a heavy sliding box and the light box at rest that it hits stop",
      "friction during the collision, late contact", false,
      [](Laboratory& laboratory) { return sliding_pair(laboratory, 0.0, 300, 100); });
  return cases;
}

}  // namespace holdfast::internal
