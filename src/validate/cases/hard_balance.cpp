#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validate/cases/hard_cases.hpp"
#include "validate/laboratory/departure.hpp"

namespace holdfast::internal {

namespace {

/// Duration of the balance cases. A body that is out of balance by 5e-4 of its length falls within 3 s: a lever arm e
/// of the weight grows as cosh(p t) with p² about 5 to 10 s⁻² in these scenes.
constexpr double kWatched = 5.0;
constexpr double kFallen = 10.0 * std::numbers::pi / 180.0;

/// Whether any box rotates by 10° within this time.
bool falls(Laboratory& laboratory, const Scene& scene) {
  double turn = 0.0;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    for (std::size_t i = 0; i < scene.boxes.size(); ++i)
      turn = std::max(turn, turn_of(scene.boxes[i].orientation.conjugate() * moment.state.orientation[i]));
    return turn < kFallen;
  });
  return turn >= kFallen || outcome.stop_reason == StopReason::failed;
}

/// A box on another, with its centre of mass inside or outside the edge below by 5e-4 of its length: it rests or falls.
/// The lower box does not tip: the common centre of mass is l/4 from its middle.
std::vector<Measurement> overhang(Laboratory& laboratory, double excess) {
  Scene scene = empty_scene({20, 20, 10}, 0.5);
  const Vec3 size = {1.0, 1.0, 0.25};
  scene.boxes = {standing_box(size, {9.5, 9.5, 0}), standing_box(size, {9.5 + 0.5 + excess, 9.5, 0.25})};
  scene.then(kWatched, {0, 0, 0});
  return {verdict("falls", falls(laboratory, scene), excess > 0.0)};
}

/// Ten boxes at the edge of a table, the k-th from the top over the one below by f l / (2 k). By induction the centre
/// of mass of the top k boxes is then (f − 1) l / 2 beyond the edge below them, at every joint: f < 1 rests, f > 1
/// topples. The whole overhang is f (l/2) (1 + 1/2 + ... + 1/10).
std::vector<Measurement> harmonic_stack(Laboratory& laboratory, double share) {
  constexpr int kCount = 10;
  Scene scene = empty_scene({20, 20, 10}, 0.5);
  const Vec3 size = {1.0, 1.0, 0.25};
  const double table_height = 1.0;
  scene.boxes = {standing_box({4.0, 2.0, table_height}, {5.0, 9.0, 0})};
  scene.boxes[0].mass = kFixed;
  double edge = 9.0;
  for (int i = 0; i < kCount; ++i) {
    edge += share * size.x() / (2.0 * (kCount - i));
    scene.boxes.push_back(standing_box(size, {edge - size.x(), 9.5, table_height + i * size.z()}));
  }
  scene.then(kWatched, {0, 0, 0});
  return {verdict("falls", falls(laboratory, scene), share > 1.0)};
}

/// A plank of length L and thickness t leans at the angle θ from the floor against the wall at x = 0, on its two lower
/// edges. With both contacts at their limit, N_w = μf m g / (1 + μf μw), and the moments about the foot,
/// N_w (μw cosθ + sinθ) L = ½ m g (L cosθ − t sinθ), it just holds at
///     tanθ = (1 − μf μw) / (2 μf + (t/L)(1 + μf μw)),
/// and at steeper angles; at flatter angles it slides down. (Valid for tanθ < 1/μf, where friction at the wall can only
/// act upwards.)
std::vector<Measurement> leaning_plank(Laboratory& laboratory, double share) {
  constexpr double kFloor = 0.5;
  constexpr double kWall = 0.3;
  const Vec3 size = {4.0, 1.0, 0.25};
  const double ratio = size.z() / size.x();
  const double limit = (1.0 - kFloor * kWall) / (2.0 * kFloor + ratio * (1.0 + kFloor * kWall));
  const double angle = std::atan(share * limit);

  Scene scene = empty_scene({20, 20, 10}, kFloor);
  scene.settings.contact.friction_model = FrictionModel::pairs;
  scene.settings.contact.box_floor = kFloor;
  scene.settings.contact.box_wall = kWall;
  SceneBox plank;
  plank.size = size;
  // The body's x axis points from the wall down to the foot.
  plank.orientation = Rotation(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  const Vec3 down = plank.orientation * Vec3::UnitX();
  const Vec3 outward = plank.orientation * Vec3::UnitZ();
  const Vec3 foot = {size.x() * std::cos(angle), 10.0, 0.0};
  plank.position = foot - 0.5 * size.x() * down + 0.5 * size.z() * outward;
  scene.boxes = {plank};
  scene.then(kWatched, {0, 0, 0});
  constexpr double kSlid = 0.01;
  return {verdict("slides down", departure(laboratory, scene, 0.0, kSlid) > kSlid, share < 1.0)};
}

/// Five boxes in a row pressed against a frictionless wall at three times their sliding limit. The inertial forces do
/// no positive work in any virtual motion that the contacts allow: the boxes rest. The distribution of the force
/// between wall and floor is not unique: the wall carries between Σ m (a − μg) and Σ m a.
std::vector<Measurement> row_against_wall(Laboratory& laboratory) {
  constexpr double kFriction = 0.5;
  Scene scene = empty_scene({20, 20, 10}, kFriction);
  scene.settings.contact.friction_model = FrictionModel::pairs;
  scene.settings.contact.box_floor = kFriction;
  scene.settings.contact.box_box = kFriction;
  scene.settings.contact.box_wall = 0.0;
  for (int i = 0; i < 5; ++i) scene.boxes.push_back(standing_box({0.5, 0.5, 0.25}, {0.5 * i, 9.75, 0}));
  scene.then(2.0, {3.0 * kFriction * scene.settings.gravity, 0, 0});
  constexpr double kMoved = 0.001;
  return {verdict("moves 1 mm", departure(laboratory, scene, 0.0, kMoved) > kMoved, false)};
}

}  // namespace

std::vector<Case> hard_balance_cases() {
  std::vector<Case> cases;
  for (const double excess : {-5e-4, 5e-4})
    cases.push_back({"hard", excess < 0.0 ? "overhang_inside" : "overhang_outside",
                     "whether a box falls whose centre of mass is 5e-4 of its length inside or outside the edge",
                     "contact points that are clipped or kept with a tolerance as large as the margin", true,
                     [=](Laboratory& l) { return overhang(l, excess); }});
  for (const double share : {1.0 - 1e-3, 1.0 + 1e-3})
    cases.push_back({"hard", share < 1.0 ? "harmonic_stack_holds" : "harmonic_stack_falls",
                     "whether ten boxes that overhang in steps, to within 1e-3 of their limit, fall",
                     "all joints are at their limit at once", false,
                     [=](Laboratory& l) { return harmonic_stack(l, share); }});
  for (const double share : {1.0 - 1e-3, 1.0 + 1e-3})
    cases.push_back({"hard", share < 1.0 ? "leaning_plank_slides" : "leaning_plank_holds",
                     "whether a plank that leans on a wall within 1e-3 of its limit slides down",
                     "contacts of edges, static indeterminacy", true,
                     [=](Laboratory& l) { return leaning_plank(l, share); }});
  cases.push_back({"hard", "row_against_wall", "whether a row pressed against a frictionless wall stays",
                   "soft contacts sink into the wall", true, row_against_wall});
  return cases;
}

}  // namespace holdfast::internal
