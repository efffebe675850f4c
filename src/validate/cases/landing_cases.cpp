#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validate/cases/rebound_cases.hpp"
#include "validate/laboratory/track.hpp"

namespace holdfast::internal {

namespace {

using enum ToleranceClass;

const Vec3 kContainer = {16, 8, 4};

double height_of(const Snapshot& state) { return state.position[0].z(); }

Measurement no_energy_gained(const Scene& scene, const Track& track, double energy) {
  return scaled("energy gained (share)", energy_gain(scene, track) / energy, 0.0, 1.0, fine);
}

/// A box falls flat from rest and does not rebound: t = √(2H/g), v = √(2gH); the whole energy m g H is lost.
std::vector<Measurement> drop_to_rest(Laboratory& laboratory, double height) {
  const Vec3 size = {1.0, 1.0, 0.5};
  Scene scene = empty_scene(kContainer, 0.5);
  const double gravity = scene.settings.gravity;
  const double time = std::sqrt(2.0 * height / gravity);
  const double speed = std::sqrt(2.0 * gravity * height);
  scene.boxes.push_back(standing_box(size, {7.5, 3.5, height}));
  scene.then(time + 0.5, Vec3::Zero());
  const Track track = track_of(laboratory, scene);
  const Arrival arrival = arrival_of(
      track, [&](const Snapshot& s) { return height_of(s) - 0.5 * size.z(); },
      [](const Snapshot& s) { return -s.velocity[0].z(); }, gravity);
  double deepest = 0.0;
  for (const Snapshot& state : track) deepest = std::max(deepest, 0.5 * size.z() - height_of(state));
  const Snapshot& end = track.back();
  return {relative("time of landing (s)", arrival.time, time, fine),
          relative("speed of landing (m/s)", arrival.speed, speed, fine),
          scaled("penetration (m)", deepest, 0.0, height, fine),
          scaled("height at the end (m)", height_of(end) - 0.5 * size.z(), 0.0, height, fine),
          scaled("speed left (m/s)", end.velocity[0].norm(), 0.0, speed, exact),
          scaled("turn (rad)", turn_of(end.orientation[0]), 0.0, 1.0, fine),
          no_energy_gained(scene, track, scene.batch().boxes.mass[0] * gravity * height)};
}

/// A box falls flat from rest and rebounds with e √(2gH), to the height e² H at the time (1 + e) √(2H/g).
std::vector<Measurement> drop_and_rebound(Laboratory& laboratory, double height, double restitution) {
  const Vec3 size = {1.0, 1.0, 0.5};
  Scene scene = empty_scene(kContainer, 0.5, restitution);
  const double gravity = scene.settings.gravity;
  const double time = std::sqrt(2.0 * height / gravity);
  scene.boxes.push_back(standing_box(size, {7.5, 3.5, height}));
  scene.then((1.0 + 1.7 * restitution) * time, Vec3::Zero());
  const Track track = track_of(laboratory, scene);
  const std::vector<Peak> peaks = peaks_of(track, height_of, 0.5 * size.z());
  const Peak peak = peaks.empty() ? Peak{0.0, 0.5 * size.z()} : peaks.front();
  return {relative("height of rebound (m)", peak.value - 0.5 * size.z(), restitution * restitution * height, fine),
          relative("time of rebound's peak (s)", peak.time, (1.0 + restitution) * time, fine),
          scaled("turn (rad)", turn_of(track.back().orientation[0]), 0.0, 1.0, fine),
          no_energy_gained(scene, track, scene.batch().boxes.mass[0] * gravity * height)};
}

/// A flat box falls from `height` with the horizontal speed u. The normal impulse m √(2gH) allows a friction impulse of
/// μ times that: Δu = min(u, μ √(2gH)); with the remaining velocity the box slides by (u − Δu)²/(2 μ g). It does not
/// pitch if h Δu <= l √(2gH): then the normal impulse is inside the base.
std::vector<Measurement> oblique_landing(Laboratory& laboratory, double height, double speed) {
  const double friction = 0.5;
  Scene scene = empty_scene(kContainer, friction);
  const double gravity = scene.settings.gravity;
  const double time = std::sqrt(2.0 * height / gravity);
  const double left = speed - std::min(speed, friction * std::sqrt(2.0 * gravity * height));
  scene.boxes.push_back(standing_box({1.0, 1.0, 0.2}, {4.0, 3.5, height}));
  scene.boxes[0].velocity = {speed, 0, 0};
  scene.then(time + left / (friction * gravity) + 0.3, Vec3::Zero());
  const Track track = track_of(laboratory, scene);
  const Snapshot& end = track.back();
  const double expected = speed * time + 0.5 * left * left / (friction * gravity);
  return {relative("displacement (m)", end.position[0].x() - scene.boxes[0].position.x(), expected, fine),
          scaled("speed left (m/s)", end.velocity[0].norm(), 0.0, speed, exact),
          scaled("turn (rad)", turn_of(end.orientation[0]), 0.0, 1.0, fine),
          no_energy_gained(scene, track, scene.batch().boxes.mass[0] * gravity * height)};
}

/// A kind of landing of a tilted box on an edge, with its centre of mass d beside and c above the edge, falling with v.
struct EdgeLanding {
  const char* name;
  double friction;
  double restitution;
};

/// Angular velocity and velocity after the impact; they do not change afterwards, because the container is then in free
/// fall and the edge leaves the floor at once. With the impulses N upwards and F sideways against the sliding, and
/// k² = R²/3 the square of the radius of gyration:
///   no friction:  N = (1 + e) m v / (1 + d²/k²)                   ω = N d / (m k²)
///   slipping:     N = (1 + e) m v / (1 + (d² − μ c d)/k²), F = μ N  ω = N (d − μ c) / (m k²), if F does not stop the
///                 sliding
///   sticking:     angular momentum about the edge is conserved, ω = v d / (k² + R²)   (e = 0)
std::vector<Measurement> edge_landing(Laboratory& laboratory, const EdgeLanding& landing) {
  const Vec3 size = {1.0, 1.0, 0.4};
  const double tilt = 0.35;
  const double speed = 1.0;
  const double gap = 0.0537;
  const double beside = 0.5 * (size.x() * std::cos(tilt) - size.z() * std::sin(tilt));
  const double above = 0.5 * (size.x() * std::sin(tilt) + size.z() * std::cos(tilt));
  const double square = 0.25 * (size.x() * size.x() + size.z() * size.z());  // R²
  const double gyration = square / 3.0;                                      // k²

  // Rotated about y, the edge at +x is the lower one; it slides towards +x, friction acts towards −x, and the rotation
  // is about −y.
  Scene scene = empty_scene(kContainer, landing.friction, landing.restitution);
  SceneBox box;
  box.size = size;
  box.position = {8.0, 4.0, above + gap};
  box.orientation = Rotation(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()));
  box.velocity = {0, 0, -speed};
  scene.boxes.push_back(box);
  scene.then(gap / speed + 0.09, {0, 0, -scene.settings.gravity});
  const Track track = track_of(laboratory, scene);
  const Snapshot& end = track.back();

  const double stuck_spin = speed * beside / (gyration + square);
  const double normal_slipping =
      (1.0 + landing.restitution) * speed / (1.0 + (beside * beside - landing.friction * above * beside) / gyration);
  const double slip = normal_slipping * ((beside - landing.friction * above) / gyration * above - landing.friction);
  const bool sticks = slip < 0.0;
  const double spin = sticks ? stuck_spin : normal_slipping * (beside - landing.friction * above) / gyration;
  const double sideways = sticks ? stuck_spin * above : landing.friction * normal_slipping;
  const double down = sticks ? stuck_spin * beside : speed - normal_slipping;
  return {relative("spin after (rad/s)", -end.angular_velocity[0].y(), spin, fine),
          scaled("sideways speed after (m/s)", -end.velocity[0].x(), sideways, speed, fine),
          scaled("downward speed after (m/s)", -end.velocity[0].z(), down, speed, fine),
          no_energy_gained(scene, track, kinetic_energy(scene, track.front()))};
}

}  // namespace

std::vector<Case> landing_cases() {
  std::vector<Case> cases;
  const auto add = [&](std::string name, std::string question, const char* failure_mode, bool quick, auto measure) {
    cases.push_back({"rebound", std::move(name), std::move(question), failure_mode, quick, measure});
  };
  for (const double height : {0.1, 0.5, 1.0}) {
    add(fmt::format("drop_e_0_from_{}", height), fmt::format("a box falls {} m flat and does not rebound", height),
        "penetration by half the path of a step", height == 0.5,
        [=](Laboratory& laboratory) { return drop_to_rest(laboratory, height); });
    for (const double e : {0.5, 1.0})
      add(fmt::format("drop_e_{}_from_{}", e, height), fmt::format("a box falls {} m with restitution {}", height, e),
          "restitution applied to the speed at the end of the step", height == 0.5,
          [=](Laboratory& laboratory) { return drop_and_rebound(laboratory, height, e); });
  }
  for (const double speed : {0.5, 1.5, 3.0})
    add(fmt::format("oblique_landing_u_{}", speed),
        fmt::format("a flat box lands after a fall of 0.5 m, with {} m/s sideways", speed),
        "friction from a wrong normal impulse", speed == 3.0,
        [=](Laboratory& laboratory) { return oblique_landing(laboratory, 0.5, speed); });
  for (const EdgeLanding landing : {EdgeLanding{"sticking", 1.0, 0.0}, EdgeLanding{"slipping", 0.3, 0.0},
                                    EdgeLanding{"frictionless", 0.0, 0.0}, EdgeLanding{"rebounding", 0.0, 0.5}})
    add(fmt::format("edge_landing_{}", landing.name), fmt::format("a tilted box lands on an edge, {}", landing.name),
        "rebound or energy loss that does not occur in a flat landing", true,
        [=](Laboratory& laboratory) { return edge_landing(laboratory, landing); });
  return cases;
}

}  // namespace holdfast::internal
