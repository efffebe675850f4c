#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validate/answers/stick_slip.hpp"
#include "validate/laboratory/case.hpp"
#include "validate/laboratory/track.hpp"

namespace holdfast::internal {

namespace {

using enum ToleranceClass;

/// Large enough that no box reaches a wall; the centre is a binary fraction, for mirrored scenes.
const Vec3 kContainer = {64, 64, 4};
const Vec3 kFlatBox = {1.0, 1.0, 0.2};
constexpr double kGravity = 9.81;

/// Time after a manoeuvre in which all boxes come to rest, s.
constexpr double kAftermath = 5.0;

/// Accelerations of a container in traffic. The front is at x = 0: braking accelerates it along +x. The breakpoints are
/// not multiples of any usual step.
Acceleration acceleration_of(const std::vector<std::pair<double, Vec3>>& pieces) {
  Scene scene;
  for (const auto& [duration, acceleration] : pieces) scene.then(duration, acceleration);
  return scene.acceleration;
}

/// Rises within `rise`, is constant, and falls again, in intervals of constant acceleration and equal length.
Acceleration trapezoid(const Vec3& acceleration, double rise, double hold) {
  constexpr int kPieces = 40;
  std::vector<std::pair<double, Vec3>> pieces = {{0.1037, Vec3::Zero()}};
  for (int i = 0; i < kPieces; ++i) pieces.push_back({rise / kPieces, acceleration * ((i + 0.5) / kPieces)});
  pieces.push_back({hold, acceleration});
  for (int i = kPieces - 1; i >= 0; --i) pieces.push_back({rise / kPieces, acceleration * ((i + 0.5) / kPieces)});
  pieces.push_back({kAftermath, Vec3::Zero()});
  return acceleration_of(pieces);
}

/// One pulse, with intervals of zero acceleration before and after.
Acceleration pulse(double duration, const Vec3& acceleration) {
  return acceleration_of({{0.1037, Vec3::Zero()}, {duration, acceleration}, {kAftermath, Vec3::Zero()}});
}

/// Design accelerations of EN 12195-1 for roads: 0.8 g forward, 0.5 g to the rear and to the sides.
Acceleration full_braking() { return pulse(1.2371, {0.8 * kGravity, 0, 0}); }
Acceleration rearward() { return pulse(1.2371, {-0.5 * kGravity, 0, 0}); }
Acceleration cornering(double side) { return pulse(1.7113, {0, side * 0.5 * kGravity, 0}); }

/// A tractor-trailer changes lane within 5.5 s, to one side and back: 2 m/s² at high speed (Schulze 2006).
Acceleration lane_change(double side, double acceleration = 2.0) {
  return acceleration_of({{0.1037, Vec3::Zero()},
                          {2.75, {0, side * acceleration, 0}},
                          {2.75, {0, -side * acceleration, 0}},
                          {kAftermath, Vec3::Zero()}});
}

/// A shunting impact of a rail wagon, 1 g, while the floor falls at 0.3 g.
Acceleration shunting() { return pulse(0.1513, {1.0 * kGravity, 0, -0.3 * kGravity}); }

Scene scene_of(const Acceleration& acceleration, double friction) {
  Scene scene = empty_scene(kContainer, friction);
  scene.boxes.push_back(standing_box(kFlatBox, {31.5, 31.5, 0}));
  scene.acceleration = acceleration;
  return scene;
}

Vec3 moved(const Scene& scene, const Snapshot& state, std::size_t i = 0) {
  return state.position[i] - scene.boxes[i].position;
}

/// A flat box under an acceleration along an axis, compared with the exact stick-slip path.
std::vector<Measurement> along(Laboratory& laboratory, int axis, const Acceleration& acceleration, double friction) {
  const Scene scene = scene_of(acceleration, friction);
  const SlidePath path = slide_along(axis, acceleration, friction, kGravity);
  if (path.stop_time == 0.0)
    return {scaled("displacement (m)", largest_displacement(laboratory, scene), 0.0, 1.0, exact)};
  const Track track = track_of(laboratory, scene);
  const Snapshot& end = track.back();
  Vec3 aside = moved(scene, end);
  aside[axis] = 0.0;
  return {relative("displacement (m)", moved(scene, end)[axis], path.displacement[axis], fine),
          relative("time of the last stop (s)", stop_time(track, 0, friction * kGravity), path.stop_time, fine),
          scaled("displacement aside (m)", aside.norm(), 0.0, path.displacement.norm(), fine),
          scaled("speed left (m/s)", end.velocity[0].norm(), 0.0, 1.0, exact)};
}

/// A flat box under a horizontal acceleration whose direction changes while it slides, compared with a path integrated
/// to 1e-8 m.
std::vector<Measurement> across(Laboratory& laboratory, const Acceleration& acceleration, double friction) {
  const Scene scene = scene_of(acceleration, friction);
  const SlidePath path = slide_over(acceleration, friction, kGravity);
  const Track track = track_of(laboratory, scene);
  const Snapshot& end = track.back();
  const Vec3 error = moved(scene, end) - path.displacement;
  const double way = path.displacement.norm();
  return {scaled("displacement along x (m)", moved(scene, end).x(), path.displacement.x(), way, good),
          scaled("displacement along y (m)", moved(scene, end).y(), path.displacement.y(), way, good),
          scaled("distance from the right place (m)", error.norm(), 0.0, way, good),
          relative("time of the last stop (s)", stop_time(track, 0, friction * kGravity), path.stop_time, good)};
}

/// The same acceleration to the left and to the right: the displacements are mirror images.
std::vector<Measurement> mirrored(Laboratory& laboratory, const Acceleration& left, const Acceleration& right,
                                  double friction) {
  const Scene scene = scene_of(left, friction);
  const Vec3 to_left = moved(scene, final_state(laboratory, scene));
  const Vec3 to_right = moved(scene, final_state(laboratory, scene_of(right, friction)));
  const double way = std::abs(slide_along(1, left, friction, kGravity).displacement.y());
  return {scaled("sum of displacements across (m)", to_left.y() + to_right.y(), 0.0, way, exact),
          scaled("difference of displacements along (m)", to_left.x() - to_right.x(), 0.0, way, exact)};
}

/// Two boxes with a gap between each other and to the front wall are braked at 0.8 g: both slide with 0.8 g − μ g. The
/// first one stops at the wall after d₁, the second one at the first after a further d₂, if the braking lasts long
/// enough; otherwise friction stops them before. Vertical faces without friction, no restitution.
std::vector<Measurement> closing_up(Laboratory& laboratory, double friction, double duration) {
  const double to_wall = 0.2037;
  const double between = 0.3519;
  Scene scene = scene_of_pairs({16, 8, 4}, friction, 0.0, 0.0);
  scene.boxes = {standing_box(kFlatBox, {to_wall, 3.5, 0}),
                 standing_box(kFlatBox, {to_wall + kFlatBox.x() + between, 3.5, 0})};
  scene.acceleration = pulse(duration, {0.8 * kGravity, 0, 0});
  const double free_way = -slide_along(0, scene.acceleration, friction, kGravity).displacement.x();
  const Track track = track_of(laboratory, scene);
  const Snapshot& end = track.back();
  double deepest = 0.0;
  for (const Snapshot& state : track) {
    deepest = std::max(deepest, 0.5 * kFlatBox.x() - state.position[0].x());
    deepest = std::max(deepest, kFlatBox.x() - (state.position[1].x() - state.position[0].x()));
  }
  return {relative("displacement of the first (m)", -moved(scene, end, 0).x(), std::min(to_wall, free_way), fine),
          relative("displacement of the second (m)", -moved(scene, end, 1).x(), std::min(to_wall + between, free_way),
                   fine),
          scaled("penetration (m)", deepest, 0.0, to_wall, fine),
          scaled("speed left (m/s)", end.velocity[0].norm() + end.velocity[1].norm(), 0.0, 1.0, exact)};
}

/// Braking at 0.3 g moves a box without friction against a box of the same mass 0.4 m in front of it, which friction
/// 0.5 holds. They collide with v = √(2 a d) and move on together with v/2. The friction of one acts on the mass of
/// two, μ/2, as long as they move: 0.3 g − 0.25 g during the braking, −0.25 g afterwards.
std::vector<Measurement> pushing(Laboratory& laboratory) {
  const double gap = 0.4037;
  const double braking = 0.3 * kGravity;
  const double duration = 0.8113;
  Scene scene = empty_scene({16, 8, 4}, 0.5);
  scene.boxes = {standing_box(kFlatBox, {8.0 + gap, 3.5, 0}), standing_box(kFlatBox, {7.0, 3.5, 0})};
  scene.boxes[0].friction = 0.0;
  scene.then(0.1037, Vec3::Zero()).then(duration, {braking, 0, 0}).then(kAftermath, Vec3::Zero());
  const double meeting = std::sqrt(2.0 * gap / braking);
  const Acceleration rest_of = acceleration_of({{duration - meeting, {braking, 0, 0}}, {kAftermath, Vec3::Zero()}});
  const SlidePath together = slide_along(0, rest_of, 0.25, kGravity, -0.5 * braking * meeting);
  const Snapshot end = final_state(laboratory, scene);
  return {relative("displacement of the first (m)", -moved(scene, end, 0).x(), gap - together.displacement.x(), fine),
          relative("displacement of the second (m)", -moved(scene, end, 1).x(), -together.displacement.x(), fine)};
}

/// A row of boxes in contact with each other and the front wall under full braking: friction balances a part of the
/// inertial forces, the wall the rest; no box can move.
std::vector<Measurement> row_at_wall(Laboratory& laboratory, int count, double friction) {
  Scene scene = empty_scene({16, 8, 4}, friction);
  for (int i = 0; i < count; ++i) scene.boxes.push_back(standing_box({1.0, 1.0, 0.5}, {1.0 * i, 3.5, 0}));
  scene.acceleration = pulse(1.2371, {0.8 * kGravity, 0, 0});
  return {scaled("largest displacement (m)", largest_displacement(laboratory, scene), 0.0, 1.0, exact)};
}

/// A row of boxes that touch slides to the rear together: there are no forces between them.
std::vector<Measurement> row_to_rear(Laboratory& laboratory, int count, double friction) {
  Scene scene = empty_scene({32, 8, 4}, friction);
  for (int i = 0; i < count; ++i) scene.boxes.push_back(standing_box({1.0, 1.0, 0.5}, {1.0 * i, 3.5, 0}));
  scene.acceleration = rearward();
  const double expected = slide_along(0, scene.acceleration, friction, kGravity).displacement.x();
  const Snapshot end = final_state(laboratory, scene);
  double worst = expected;
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const double way = moved(scene, end, i).x();
    if (std::abs(way - expected) >= std::abs(worst - expected)) worst = way;
  }
  return {relative("displacement farthest off (m)", worst, expected, fine)};
}

/// A small box on a wide flat one of four times its mass, under full braking, compared with the exact stick-slip paths.
std::vector<Measurement> box_on_box(Laboratory& laboratory, double floor_friction, double upper_friction) {
  Scene scene = scene_of_pairs(kContainer, floor_friction, upper_friction, 0.0);
  scene.boxes = {standing_box({6.0, 2.0, 0.2}, {29.0, 31.0, 0}), standing_box({0.5, 0.5, 0.1}, {31.75, 31.75, 0.2})};
  scene.boxes[0].mass = 400.0;
  scene.boxes[1].mass = 100.0;
  scene.acceleration = pulse(0.5371, {0.8 * kGravity, 0, 0});
  const StackedPaths paths =
      slide_stacked(scene.acceleration, {400.0, 100.0, floor_friction, upper_friction, kGravity});
  const Snapshot end = final_state(laboratory, scene);
  const double way = std::abs(paths.upper);
  return {scaled("displacement of the lower one (m)", moved(scene, end, 0).x(), paths.lower, way, fine),
          scaled("displacement of the upper one (m)", moved(scene, end, 1).x(), paths.upper, way, fine)};
}

}  // namespace

std::vector<Case> manoeuvre_cases() {
  std::vector<Case> cases;
  const auto add = [&](std::string name, std::string question, const char* failure_mode, bool quick, auto measure) {
    cases.push_back({"manoeuvre", std::move(name), std::move(question), failure_mode, quick, measure});
  };
  const char* const edges = "first-order time stepping, steps that contain a breakpoint, stops not located in time";
  for (const double mu : {0.2, 0.3, 0.45, 0.6})
    add(fmt::format("full_braking_mu_{}", mu), fmt::format("full braking at 0.8 g, friction {}", mu), edges, mu == 0.45,
        [=](Laboratory& l) { return along(l, 0, full_braking(), mu); });
  for (const double mu : {0.2, 0.3, 0.45, 0.5, 0.55})
    add(fmt::format("rearward_mu_{}", mu), fmt::format("0.5 g to the rear, friction {}", mu),
        mu == 0.5 ? "motion although the acceleration is exactly at the limit" : edges, mu == 0.45,
        [=](Laboratory& l) { return along(l, 0, rearward(), mu); });
  for (const double mu : {0.2, 0.3, 0.45, 0.5, 0.55}) {
    add(fmt::format("cornering_left_mu_{}", mu), fmt::format("cornering at 0.5 g to the left, friction {}", mu),
        mu == 0.5 ? "motion although the acceleration is exactly at the limit" : edges, mu == 0.3,
        [=](Laboratory& l) { return along(l, 1, cornering(1.0), mu); });
    if (mu < 0.5)
      add(fmt::format("cornering_mirrored_mu_{}", mu),
          fmt::format("whether left and right corners are mirror images, friction {}", mu), "a bias by order or sign",
          mu == 0.3, [=](Laboratory& l) { return mirrored(l, cornering(1.0), cornering(-1.0), mu); });
  }
  for (const double mu : {0.1, 0.15, 0.2, 0.3})
    add(fmt::format("lane_change_mu_{}", mu), fmt::format("lane change at 2 m/s², friction {}", mu),
        mu < 0.2038 ? "sliding reverses: the errors of both halves add up" : "creep below the limit",
        mu == 0.15 || mu == 0.3, [=](Laboratory& l) { return along(l, 1, lane_change(1.0), mu); });
  add("lane_change_hard_mu_0.3", "lane change at 4 m/s², friction 0.3",
      "sliding reverses: the errors of both halves add up", true,
      [](Laboratory& l) { return along(l, 1, lane_change(1.0, 4.0), 0.3); });
  add("lane_change_mirrored_mu_0.15", "whether lane changes to the left and to the right are mirror images",
      "a bias by order or sign", false,
      [](Laboratory& l) { return mirrored(l, lane_change(1.0), lane_change(-1.0), 0.15); });
  for (const double mu : {0.3, 0.45}) {
    add(fmt::format("ramped_braking_mu_{}", mu),
        fmt::format("braking that rises within 0.3 s to 0.8 g, friction {}", mu), "the start of sliding within a ramp",
        mu == 0.45, [=](Laboratory& l) {
          return along(l, 0, trapezoid({0.8 * kGravity, 0, 0}, 0.3, 0.7113), mu);
        });
    add(fmt::format("shunting_mu_{}", mu),
        fmt::format("a shunting impact of 1 g with 0.3 g less weight, friction {}", mu),
        "friction computed from the full weight", mu == 0.45,
        [=](Laboratory& l) { return along(l, 0, shunting(), mu); });
    add(fmt::format("braking_then_cornering_mu_{}", mu),
        fmt::format("cornering at 0.5 g begins while the box slides under braking at 0.8 g, friction {}", mu),
        "friction not along the velocity: friction pyramids, fixed directions", mu == 0.45, [=](Laboratory& l) {
          const Acceleration acceleration = acceleration_of({{0.1037, Vec3::Zero()},
                                                             {0.6371, {0.8 * kGravity, 0, 0}},
                                                             {0.5113, {0, 0.5 * kGravity, 0}},
                                                             {kAftermath, Vec3::Zero()}});
          return across(l, acceleration, mu);
        });
    add(fmt::format("braking_in_a_corner_mu_{}", mu),
        fmt::format("braking at 0.7 g within a corner of 0.5 g, friction {}", mu),
        "friction not along the velocity: friction pyramids, fixed directions", mu == 0.45, [=](Laboratory& l) {
          const Acceleration acceleration = acceleration_of({{0.1037, Vec3::Zero()},
                                                             {0.4371, {0, 0.5 * kGravity, 0}},
                                                             {0.6113, {0.7 * kGravity, 0.5 * kGravity, 0}},
                                                             {0.3371, {0, 0.5 * kGravity, 0}},
                                                             {kAftermath, Vec3::Zero()}});
          return across(l, acceleration, mu);
        });
    add(fmt::format("diagonal_braking_mu_{}", mu),
        fmt::format("0.6 g forward and 0.35 g sideways at once, friction {}", mu),
        "friction pyramids: each axis has its own limit", mu == 0.45, [=](Laboratory& l) {
          return across(l, pulse(0.9371, {0.6 * kGravity, 0.35 * kGravity, 0}), mu);
        });
  }
  for (const double duration : {0.9371, 0.2371})
    add(fmt::format("closing_up_{}_s", duration),
        fmt::format("braking for {} s closes gaps to the wall and between two boxes", duration),
        "rebound, penetration, contact at a distance", duration > 0.5,
        [=](Laboratory& l) { return closing_up(l, 0.45, duration); });
  add("pushing", "a box without friction pushes one with friction", "momentum in the collision, force after it", true,
      pushing);
  for (const int count : {1, 3, 8}) {
    add(fmt::format("row_of_{}_at_wall", count), fmt::format("full braking of {} boxes in a row at the wall", count),
        "soft contacts, creep", count == 3, [=](Laboratory& l) { return row_at_wall(l, count, 0.45); });
    if (count > 1)
      add(fmt::format("row_of_{}_to_rear", count), fmt::format("0.5 g to the rear moves a row of {} boxes", count),
          "forces between boxes that only touch", count == 3,
          [=](Laboratory& l) { return row_to_rear(l, count, 0.3); });
  }
  struct Frictions {
    double floor;
    double upper;
    const char* what;
  };
  for (const Frictions f :
       {Frictions{0.3, 0.2, "both slide, one on the other"}, Frictions{0.2, 0.4, "both slide together"},
        Frictions{0.6, 0.3, "both slide, the lower one less"}, Frictions{0.9, 0.3, "the upper one slides alone"}})
    add(fmt::format("box_on_box_{}_on_{}", f.upper, f.floor), fmt::format("full braking, box on box: {}", f.what),
        "friction at one contact affects the other", f.floor == 0.3,
        [=](Laboratory& l) { return box_on_box(l, f.floor, f.upper); });
  return cases;
}

}  // namespace holdfast::internal
