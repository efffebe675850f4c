#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "validate/answers/toppling.hpp"
#include "validate/laboratory/case.hpp"
#include "validate/laboratory/threshold.hpp"

namespace holdfast::internal {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRest = 0.25;  ///< before the acceleration, s
constexpr double kPush = 5.0;   ///< duration of the acceleration, s
constexpr double kTipped = 10.0 * kDegree;
constexpr double kPrecision = 1e-7;    ///< to which an exact threshold is found
constexpr double kHighFriction = 2.0;  ///< above the coefficient that any body here needs to pivot without sliding

/// A box in the middle of a large container, which is high enough for any fall.
Scene scene_of(const Vec3& size, double friction = kHighFriction) {
  Scene scene = empty_scene({40, 40, 20}, friction);
  scene.boxes.push_back(standing_box(size, {20 - 0.5 * size.x(), 20 - 0.5 * size.y(), 0}));
  return scene;
}

/// True when any box rotates by 10 degrees, or moves by more than `reach`, m, before the end of the acceleration.
bool tips(Laboratory& laboratory, const Scene& scene, double reach) {
  bool tipped = false;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    for (std::size_t i = 0; i < scene.boxes.size() && !tipped; ++i)
      tipped = turn_of(moment.state.orientation[i]) >= kTipped ||
               (moment.state.position[i] - scene.boxes[i].position).norm() > reach;
    return !tipped;
  });
  return tipped || outcome.stop_reason == StopReason::failed;
}

/// The smallest acceleration that tips something of the scene within 5 s.
/// @param scene without accelerations
/// @param body  the boxes that tip, as one rigid body: the expected threshold is that of its exact toppling by 10
/// degrees
///   within 5 s
Measurement tip_threshold(Laboratory& laboratory, const Scene& scene, const Pivoted& body, const Vec3& heading) {
  const double gravity = scene.settings.gravity;
  const double expected = toppling_threshold(body, gravity, kTipped, kPush);
  // The centre of mass of a tipping box is at most two arms from the pivot; half of that is added as a margin.
  const double reach = 3.0 * body.arm * kTipped;
  const double found = threshold_near(expected, kPrecision, [&](double acceleration) {
    Scene pushed = scene;
    pushed.then(kRest, Vec3::Zero()).then(kPush, acceleration * heading);
    return tips(laboratory, pushed, reach);
  });
  return relative("acceleration that tips it (g)", found / gravity, expected / gravity, ToleranceClass::fine);
}

/// The rolling test of Martinez-Franco et al. (section 4.3): l/h from 0.2 to 0.8, friction high enough not to slide
/// (the paper raises it until the box rolls). The box has a square base and is a metre high. Along the normal of an
/// edge it tips about the edge: a h/2 = g l/2, a = g l/h. Along a diagonal the centre of pressure moves towards the
/// corner, at a distance of l/√2, and the box tips when it is there: a h/2 = g l/√2, a = √2 g l/h. (The components a/√2
/// reach g l/h at both edges at once.)
std::vector<Case> rolling_tests() {
  struct Heading {
    const char* name;
    Vec3 direction;
    bool diagonal;
  };
  const double share = 1.0 / std::numbers::sqrt2;
  const std::array<Heading, 4> headings = {{{"along_x", Vec3::UnitX(), false},
                                            {"along_y", Vec3::UnitY(), false},
                                            {"diagonal", Vec3(share, share, 0), true},
                                            {"other_diagonal", Vec3(-share, share, 0), true}}};
  std::vector<Case> cases;
  for (const Heading& heading : headings) {
    for (int tenths = 2; tenths <= 8; ++tenths) {
      const double length = tenths / 10.0;
      cases.push_back({"tip", fmt::format("tip_ratio_{:.1f}_{}", length, heading.name),
                       fmt::format("smallest acceleration that tips a box of l/h = {:.1f}", length),
                       "soft contacts move the pivot inwards", heading.name == headings[0].name,
                       [=](Laboratory& laboratory) -> std::vector<Measurement> {
                         const Pivoted body = heading.diagonal ? about_corner(length, 1.0) : about_edge(length, 1.0);
                         return {tip_threshold(laboratory, scene_of({length, length, 1.0}), body, heading.direction)};
                       }});
    }
  }
  return cases;
}

/// The box of the toppling cases: l/h = 0.5, a metre high. Until 45 degrees and at 1.1 g l/h it needs a friction of
/// 0.52 to pivot without sliding, so that the exact motion is that of `Toppling`. (Not much farther: the vertical force
/// on the pivot becomes zero, and it lifts off before 60 degrees at any friction.)
const Vec3 kTopplingBox(0.5, 0.5, 1.0);
const Pivoted kToppling = about_edge(0.5, 1.0);
/// A panel: l/h = 0.3, twice as wide as high. It needs a friction coefficient of 0.31 until 45 degrees.
const Vec3 kPanel(0.15, 1.0, 0.5);

/// Ten seconds at 0.999 and 1.001 of g l/h: at rest, or tipped.
std::vector<Measurement> tip_near_limit(Laboratory& laboratory) {
  Scene below = scene_of(kTopplingBox);
  const double limit = 0.5 * below.settings.gravity;
  below.then(10.0, {0.999 * limit, 0, 0});
  Scene above = scene_of(kTopplingBox);
  above.then(10.0, {1.001 * limit, 0, 0});
  return {scaled("displacement below the limit (m)", largest_displacement(laboratory, below), 0.0, 1.0,
                 ToleranceClass::exact),
          verdict("tips above the limit", tips(laboratory, above, 10.0), true)};
}

/// A cube of friction 2 tips from a = g on and does not slide: at 1.2 g it needs a friction of 1.05 until 30 degrees.
std::vector<Measurement> tip_cube(Laboratory& laboratory) {
  const Scene cube = scene_of({1.0, 1.0, 1.0});
  const double acceleration = 1.2 * cube.settings.gravity;
  Scene pushed = cube;
  pushed.then(Toppling(about_edge(1.0, 1.0), acceleration, cube.settings.gravity).time_to(30.0 * kDegree),
              {acceleration, 0, 0});
  const Snapshot end = final_state(laboratory, pushed);
  const Vec3 arm(-0.5, 0, -0.5);
  const Vec3 pivot = end.position[0] + end.orientation[0] * arm;
  return {tip_threshold(laboratory, cube, about_edge(1.0, 1.0), Vec3::UnitX()),
          scaled("displacement of the pivot (m)", (pivot - cube.boxes[0].position - arm).norm(), 0.0, 1.0,
                 ToleranceClass::fine)};
}

/// The angle of a toppling box compared with the exact one: when that is 30 and 45 degrees, and the largest error
/// before, in degrees. The acceleration exceeds the threshold by the fraction `share`, after an interval of rest.
std::vector<Measurement> topple(Laboratory& laboratory, const Vec3& size, double share) {
  Scene scene = scene_of(size);
  const double gravity = scene.settings.gravity;
  const Pivoted body = about_edge(size.x(), size.z());
  const double acceleration = (1.0 + share) * gravity * size.x() / size.z();
  Toppling exact(body, acceleration, gravity);
  const double half_way = exact.time_to(30.0 * kDegree);
  const double end = exact.time_to(45.0 * kDegree);
  // Phases, and therefore steps, end at the times at which the exact angles are reached.
  scene.then(kRest, Vec3::Zero()).then(half_way, {acceleration, 0, 0}).then(end - half_way, {acceleration, 0, 0});

  std::vector<std::pair<double, double>> angles;  // time since the start of the acceleration, angle
  laboratory.run(scene, [&](const Moment& moment) {
    if (moment.time > kRest) angles.emplace_back(moment.time - kRest, turn_of(moment.state.orientation[0]));
    return true;
  });
  double at_half_way = 0.0;
  double worst = 0.0;
  Toppling reference(body, acceleration, gravity);
  for (const auto& [time, angle] : angles) {
    reference.advance_to(time);
    worst = std::max(worst, std::abs(angle - reference.angle()));
    if (std::abs(time - half_way) < kSameInstant) at_half_way = angle;
  }
  const double at_end = angles.empty() ? 0.0 : angles.back().second;
  return {scaled("angle at 30 degrees (degrees)", at_half_way / kDegree, 30.0, 1.0, ToleranceClass::good),
          scaled("angle at 45 degrees (degrees)", at_end / kDegree, 45.0, 1.0, ToleranceClass::good),
          scaled("largest error below 45 degrees (degrees)", worst / kDegree, 0.0, 1.0, ToleranceClass::good)};
}

/// The box of the toppling cases, tilted about the lower edge over which an acceleration along x tips it.
Scene tilted(double angle) {
  Scene scene = scene_of(kTopplingBox);
  SceneBox& box = scene.boxes[0];
  const Vec3 arm(0.5 * kTopplingBox.x(), 0, 0.5 * kTopplingBox.z());
  const Vec3 pivot = box.position - arm;
  box.orientation = Rotation(Eigen::AngleAxisd(-angle, Vec3::UnitY()));
  box.position = pivot + box.orientation * arm;
  return scene;
}

/// Under a < g l/h the box, released at rest, topples from θ_c = α − atan(a/g) on: there its centre of mass is above
/// the pivot, along the effective gravity. From 1e-4 beside θ_c, the direction is clear after three seconds (e^(3.6
/// t)).
std::vector<Measurement> point_of_no_return(Laboratory& laboratory) {
  const double gravity = scene_of(kTopplingBox).settings.gravity;
  const double acceleration = 0.5 * 0.5 * gravity;
  const double critical = kToppling.lean - std::atan(acceleration / gravity);
  const double found = threshold_near(critical, kPrecision, [&](double angle) {
    Scene scene = tilted(angle);
    scene.then(6.0, {acceleration, 0, 0});
    bool falls = false;
    laboratory.run(scene, [&](const Moment& moment) {
      const double now = turn_of(moment.state.orientation[0]);
      falls = now > angle + 5.0 * kDegree;
      return !falls && now > angle - 5.0 * kDegree;
    });
    return falls;
  });
  return {relative("tilt from which it topples (rad)", found, critical, ToleranceClass::good)};
}

/// The shortest pulse of 1.5 g l/h that overturns the box, by the exact criterion (`overturning_pulse`), not that for
/// slender blocks. It needs a friction coefficient of 0.56, at the start. A tolerance of 1 % distinguishes the
/// formulas.
std::vector<Measurement> overturning(Laboratory& laboratory) {
  const Scene scene = scene_of(kTopplingBox);
  const double gravity = scene.settings.gravity;
  const double acceleration = 1.5 * 0.5 * gravity;
  const double expected = overturning_pulse(kToppling, acceleration, gravity);
  const double found = threshold_near(expected, kPrecision, [&](double pulse) {
    Scene pushed = scene;
    pushed.then(kRest, Vec3::Zero()).then(pulse, {acceleration, 0, 0}).then(5.0, Vec3::Zero());
    const double over = kToppling.lean + 10.0 * kDegree;
    return std::isfinite(
        time_to_reach(laboratory, pushed, over, [](const StateView& state) { return turn_of(state.orientation[0]); }));
  });
  return {relative("shortest pulse that overturns it (s)", found, expected, ToleranceClass::coarse)};
}

/// Tipped with 1.2 g l/h up to 40 degrees, and then under gravity alone, the box ends flat on its side. (The pivot
/// lifts off at 71 degrees. The box does not rock further: for a landing on a face of length h and height l, the
/// angular velocity after the impact about the far edge would be 1 − (3/2) h²/(l² + h²) = −0.2 of that before.) After
/// the acceleration no work is done on the box: its energy never increases.
std::vector<Measurement> lands_flat(Laboratory& laboratory) {
  Scene scene = scene_of(kTopplingBox);
  const double gravity = scene.settings.gravity;
  const double acceleration = 1.2 * 0.5 * gravity;
  const double push = Toppling(kToppling, acceleration, gravity).time_to(40.0 * kDegree);
  scene.then(push, {acceleration, 0, 0}).then(4.0, Vec3::Zero());
  const Vec3 squares = kTopplingBox.cwiseProduct(kTopplingBox);
  const Vec3 moments = Vec3::Constant(squares.sum()) - squares;  // times 12, over the mass

  double energy = 0.0;
  double rise = 0.0;
  double least_energy = std::numeric_limits<double>::infinity();
  double turn = 0.0;
  double speed = 0.0;
  laboratory.run(scene, [&](const Moment& moment) {
    if (moment.time < push - kSameInstant) return true;
    const Rotation& orientation = moment.state.orientation[0];
    const Vec3 spin = orientation.conjugate() * moment.state.angular_velocity[0];
    energy = gravity * moment.state.position[0].z() + 0.5 * moment.state.velocity[0].squaredNorm() +
             0.5 * moments.dot(spin.cwiseProduct(spin)) / 12.0;
    rise = std::max(rise, energy - least_energy);
    least_energy = std::min(least_energy, energy);
    turn = turn_of(orientation);
    speed = moment.state.velocity[0].norm() + moment.state.angular_velocity[0].norm();
    return true;
  });
  return {verdict("lies flat on its side", std::abs(turn - 90.0 * kDegree) < 0.1 * kDegree, true),
          verdict("lies still", speed < 1e-3, true),
          scaled("growth of energy (J/kg)", rise, 0.0, gravity * kTopplingBox.z(), ToleranceClass::fine)};
}

/// Flat boxes of a metre by 0.2 m on each other: of all upper parts of the stack the whole stack, of height H, tips
/// first, at g l/H.
Scene stack_of(int count) {
  Scene scene = empty_scene({40, 40, 20}, kHighFriction);
  for (int i = 0; i < count; ++i) scene.boxes.push_back(standing_box({1.0, 1.0, 0.2}, {19.5, 19.5, 0.2 * i}));
  return scene;
}

/// While the stack rotates by 10 degrees no joint opens or slides: the bending moment of a rotating column is at most
/// about (1/27) m g H sin θ; an interface at that height can transmit (2/3) m g l/2.
std::vector<Measurement> stack_tips(Laboratory& laboratory, int count) {
  return {tip_threshold(laboratory, stack_of(count), about_edge(1.0, 0.2 * count), Vec3::UnitX())};
}

std::vector<Measurement> stack_rests(Laboratory& laboratory) {
  Scene scene = stack_of(20);
  scene.then(10.0, {0.9 * 0.25 * scene.settings.gravity, 0, 0});
  return {scaled("largest displacement in 10 s (m)", largest_displacement(laboratory, scene), 0.0, 1.0,
                 ToleranceClass::fine)};
}

}  // namespace

std::vector<Case> tip_cases() {
  std::vector<Case> cases = rolling_tests();
  const std::vector<Case> others = {
      {"tip", "tip_near_limit", "rest or fall at 0.999 and 1.001 of the limit",
       "soft contacts let it tip below the limit", true, tip_near_limit},
      {"tip", "tip_cube_high_friction", "a cube of friction 2 tips and does not slide", "friction limited to 1", true,
       tip_cube},
      {"tip", "tip_point_of_no_return", "tilt from which a box under an acceleration falls over",
       "energy from position correction", true, point_of_no_return},
      {"tip", "tip_overturning_pulse", "shortest pulse that overturns a box", "energy gained or lost in between", true,
       overturning},
      {"tip", "tip_lands_on_its_side", "a box that is tipped over ends flat on its side",
       "the contact normal changes at 45 degrees; the landing adds energy", true, lands_flat},
      {"tip", "tip_stack_20_rests", "20 boxes on each other are at rest at 0.9 of their limit",
       "sweeps over the contacts do not propagate from bottom to top", false, stack_rests},
      {"tip", "tip_stack_5", "smallest acceleration that tips 5 boxes on each other",
       "sweeps over the contacts do not propagate from bottom to top", false,
       [](Laboratory& laboratory) { return stack_tips(laboratory, 5); }},
      {"tip", "tip_stack_10", "smallest acceleration that tips 10 boxes on each other",
       "sweeps over the contacts do not propagate from bottom to top", false,
       [](Laboratory& laboratory) { return stack_tips(laboratory, 10); }},
      {"tip", "tip_stack_20", "smallest acceleration that tips 20 boxes on each other",
       "sweeps over the contacts do not propagate from bottom to top", false,
       [](Laboratory& laboratory) { return stack_tips(laboratory, 20); }},
  };
  cases.insert(cases.end(), others.begin(), others.end());
  for (const auto& [name, size] : {std::pair("tower", kTopplingBox), std::pair("panel", kPanel)}) {
    for (const int percent : {2, 10}) {
      cases.push_back(
          {"tip", fmt::format("topple_{}_{}_percent_over", name, percent),
           fmt::format("angle of a toppling {}, {} % over its limit", name, percent),
           "first-order integration of the rotation; a late or early start", true,
           [size = size, percent](Laboratory& laboratory) { return topple(laboratory, size, percent / 100.0); }});
    }
  }
  return cases;
}

}  // namespace holdfast::internal
