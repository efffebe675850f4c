#include "validate/cases/slide_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "validate/answers/sliding_block.hpp"
#include "validate/laboratory/threshold.hpp"

namespace holdfast::internal {

namespace {

constexpr double kRest = 0.25;       ///< before the acceleration, s
constexpr double kPush = 2.0;        ///< duration of the acceleration, s
constexpr double kPrecision = 1e-7;  ///< to which an exact threshold is found

struct Heading {
  const char* name;
  double degrees;  ///< of the container's acceleration, from x to y
};
constexpr std::array<Heading, 4> kHeadings = {
    {{"along_x", 0.0}, {"along_y", 90.0}, {"diagonal", 45.0}, {"other_diagonal", 135.0}}};

/// Unit vector in the floor's plane; exact along the axes.
Vec3 towards(double degrees) {
  if (degrees == 90.0) return Vec3::UnitY();
  const double angle = degrees * std::numbers::pi / 180.0;
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// Largest distance along the floor of any box from its start, m; infinite if the run failed. Ends the run at `limit`.
double largest_drift(Laboratory& laboratory, const Scene& scene, double limit) {
  double largest = 0.0;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    for (std::size_t i = 0; i < scene.boxes.size(); ++i)
      largest = std::max(largest, (moment.state.position[i] - scene.boxes[i].position).head<2>().norm());
    return largest <= limit;
  });
  return outcome.stop_reason == StopReason::failed ? kFixed : largest;
}

/// The smallest acceleration that moves any box of the scene by more than 1 mm and by more than 10 mm. Just above the
/// threshold, μ (g + a_z), boxes and stacks move by ½ (a − threshold) t². (All boxes of a stack move alike: the floor
/// decelerates the whole stack by the threshold, and no box can be decelerated by more.) The limit d is exceeded from
/// a = threshold + 2 d / t² on.
/// @param scene without accelerations
/// @param heave vertical acceleration of the container, from the start on, m/s²
std::vector<Measurement> slide_threshold(Laboratory& laboratory, const Scene& scene, double friction,
                                         const Vec3& heading, double heave = 0.0) {
  const double gravity = scene.settings.gravity;
  std::vector<Measurement> measurements;
  for (const double limit : {0.001, 0.01}) {
    const double expected = friction * (gravity + heave) + 2.0 * limit / (kPush * kPush);
    const double found = threshold_near(expected, kPrecision, [&](double acceleration) {
      Scene pushed = scene;
      pushed.then(kRest, heave * Vec3::UnitZ()).then(kPush, acceleration * heading + heave * Vec3::UnitZ());
      return largest_drift(laboratory, pushed, limit) > limit;
    });
    measurements.push_back(relative(fmt::format("acceleration that moves it {:g} mm (g)", 1000.0 * limit),
                                    found / gravity, expected / gravity, ToleranceClass::fine));
  }
  return measurements;
}

/// The sliding test of Martinez-Franco et al. (section 4.2): a box of 25 x 110 x 55 cm, friction 0.1 to 0.8, a = μ g.
/// It is on its largest face: l/h = 4.4 along x and 2.2 along y, above every μ, so that it slides before it tips in
/// every heading.
Scene sliding_test(double friction) {
  Scene scene = empty_scene({10, 10, 3}, friction);
  scene.boxes.push_back(standing_box({1.10, 0.55, 0.25}, {4.45, 4.725, 0}));
  return scene;
}

std::vector<Case> sliding_tests() {
  std::vector<Case> cases;
  for (const Heading& heading : kHeadings) {
    for (int tenths = 1; tenths <= 8; ++tenths) {
      const double friction = tenths / 10.0;
      cases.push_back({"slide", fmt::format("slide_mu_{:.1f}_{}", friction, heading.name),
                       fmt::format("smallest acceleration that slides the paper's box of friction {:.1f}", friction),
                       "creep below the limit; a friction pyramid holds more on the diagonals", heading.degrees == 0.0,
                       [=](Laboratory& laboratory) {
                         return slide_threshold(laboratory, sliding_test(friction), friction, towards(heading.degrees));
                       }});
    }
  }
  return cases;
}

/// A flat box of friction 0.5 in the middle of a large floor.
Scene flat_box(double friction = 0.5) {
  Scene scene = empty_scene({60, 60, 10}, friction);
  scene.boxes.push_back(standing_box({1.0, 1.0, 0.2}, {29.5, 29.5, 0}));
  return scene;
}

/// A flat box under a constant acceleration of 1.5 μg along x for a second. It slides opposite to the acceleration with
/// a − μg and moves by −½ (a − μg) t². Its kinetic energy is the work of the inertial force, m a |x|, minus that of
/// friction, μ m g |x|.
std::vector<Measurement> slide_path(Laboratory& laboratory) {
  const double friction = 0.5;
  Scene scene = flat_box(friction);
  const double gravity = scene.settings.gravity;
  const double excess = 0.5 * friction * gravity;
  scene.then(1.0, {friction * gravity + excess, 0, 0});
  const Snapshot end = final_state(laboratory, scene);
  const double moved = end.position[0].x() - scene.boxes[0].position.x();
  return {relative("displacement (m)", moved, -0.5 * excess, ToleranceClass::exact),
          relative("velocity (m/s)", end.velocity[0].x(), -excess, ToleranceClass::exact),
          relative("kinetic energy over the path (J/kg)", 0.5 * end.velocity[0].squaredNorm(), excess * std::abs(moved),
                   ToleranceClass::exact)};
}

/// Ten seconds at (1 ± margin) μg: no displacement, or ½ margin μg t².
std::vector<Measurement> slide_near_limit(Laboratory& laboratory, double margin) {
  const double limit = 0.5 * empty_scene({1, 1, 1}, 0.5).settings.gravity;
  Scene below = flat_box();
  below.then(10.0, {(1.0 - margin) * limit, 0, 0});
  Scene above = flat_box();
  above.then(10.0, {(1.0 + margin) * limit, 0, 0});
  const Snapshot end = final_state(laboratory, above);
  return {scaled("creep below the limit (m)", largest_drift(laboratory, below, 100.0), 0.0, 1.0, ToleranceClass::exact),
          relative("displacement above the limit (m)", end.position[0].x() - above.boxes[0].position.x(),
                   -0.5 * margin * limit * 100.0, ToleranceClass::fine)};
}

/// Every 5 degrees: at (1 − 1e-3) μg rest; at (1 + 1e-3) μg the path ½ 1e-3 μg t²; at 1.5 μg sliding opposite to the
/// acceleration. The friction cone is circular: all headings are equivalent. The largest error counts.
std::vector<Measurement> slide_every_heading(Laboratory& laboratory) {
  const double limit = 0.5 * empty_scene({1, 1, 1}, 0.5).settings.gravity;
  double creep = 0.0;
  double path_error = 0.0;
  double turn = 0.0;
  for (int degrees = 0; degrees < 360; degrees += 5) {
    const Vec3 heading = towards(degrees);
    const auto displacement = [&](double acceleration, double duration) {
      Scene scene = flat_box();
      scene.then(duration, acceleration * heading);
      return Vec3(final_state(laboratory, scene).position[0] - scene.boxes[0].position);
    };
    creep = std::max(creep, displacement(0.999 * limit, kPush).head<2>().norm());
    const double path = 0.5 * 1e-3 * limit * kPush * kPush;
    path_error = std::max(path_error, std::abs(-displacement(1.001 * limit, kPush).dot(heading) / path - 1.0));
    const Vec3 slip = -displacement(1.5 * limit, 1.0);
    const double across = heading.x() * slip.y() - heading.y() * slip.x();
    turn = std::max(turn, std::abs(std::atan2(across, heading.dot(slip))));
  }
  return {scaled("largest creep below the limit (m)", creep, 0.0, 1.0, ToleranceClass::exact),
          scaled("largest error of the path above it (share)", path_error, 0.0, 1.0, ToleranceClass::fine),
          scaled("largest turn of the slip off the load (rad)", turn, 0.0, 1.0, ToleranceClass::fine)};
}

/// A brake pulse: the box accelerates to (a − μg) T, then friction stops it after (a − μg) T / (μg). In total it moves
/// by ½ (a − μg) T² + ½ ((a − μg) T)² / (μg) = ½ (a − μg) T² a / (μg), and stops a T / (μg) after the start of the
/// pulse.
/// @param wait  time before the pulse, s
/// @param pulse duration T of the pulse, s
std::vector<Measurement> slide_pulse(Laboratory& laboratory, double wait, double pulse) {
  Scene scene = flat_box();
  const double limit = 0.5 * scene.settings.gravity;
  const double acceleration = 1.6 * limit;
  const double coasting = pulse * (acceleration / limit - 1.0);
  if (wait > 0.0) scene.then(wait, Vec3::Zero());
  scene.then(pulse, {acceleration, 0, 0}).then(coasting + 0.1, Vec3::Zero());
  const double path = 0.5 * (acceleration - limit) * pulse * pulse * acceleration / limit;
  const double stopped = final_state(laboratory, scene).position[0].x();
  scene.then(1.0, Vec3::Zero());
  const double later = final_state(laboratory, scene).position[0].x();
  return {relative("displacement (m)", stopped - scene.boxes[0].position.x(), -path, ToleranceClass::fine),
          scaled("creep in the second after the stop (m)", later - stopped, 0.0, 1.0, ToleranceClass::exact)};
}

/// The end of a run along x, m and m/s; nothing where the engine cannot model the scene.
struct EndAlongX {
  double displacement = 0.0;
  double velocity = 0.0;
};

std::optional<EndAlongX> end_along_x(Laboratory& laboratory, const Scene& scene) {
  EndAlongX end;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    end = {moment.state.position[0].x() - scene.boxes[0].position.x(), moment.state.velocity[0].x()};
    return true;
  });
  return outcome.stop_reason == StopReason::failed ? std::nullopt : std::optional(end);
}

constexpr double kKineticShare = 0.75;

/// A box with static friction 0.5 and three quarters of it while it slides.
Scene kinetic_box() {
  Scene scene = flat_box();
  scene.settings.contact.kinetic_friction = kKineticShare;
  return scene;
}

/// It rests at 0.99 μ_s g, more than kinetic friction could hold; at 1.2 μ_s g it gains a − μ_k g. Engines with one
/// coefficient are not measured.
std::vector<Measurement> kinetic_start(Laboratory& laboratory) {
  const double limit = 0.5 * kinetic_box().settings.gravity;
  Scene held = kinetic_box();
  held.then(1.0, {0.99 * limit, 0, 0});
  Scene pushed = kinetic_box();
  pushed.then(1.0, {1.2 * limit, 0, 0});
  const auto rest = end_along_x(laboratory, held);
  const auto end = end_along_x(laboratory, pushed);
  if (!rest || !end) return {};
  const double excess = (1.2 - kKineticShare) * limit;
  return {scaled("creep below the static limit (m)", rest->displacement, 0.0, 1.0, ToleranceClass::exact),
          relative("displacement above it (m)", end->displacement, -0.5 * excess, ToleranceClass::exact),
          relative("velocity (m/s)", end->velocity, -excess, ToleranceClass::exact)};
}

/// It starts at 1.2 μ_s g, goes on at 0.85 μ_s g, which would not have moved it and which it gains from while it
/// slides, stops, holds at 0.9 μ_s g, and starts again the other way. Engines with one coefficient are not measured.
std::vector<Measurement> kinetic_stops_and_holds(Laboratory& laboratory) {
  Scene scene = kinetic_box();
  const double limit = 0.5 * scene.settings.gravity;
  for (const auto& [duration, share] : {std::pair(0.3, 1.2), {0.3, 0.85}, {0.5, 0.0}, {0.5, 0.9}})
    scene.then(duration, {share * limit, 0, 0});
  const SlidingBlock stopped = slide_along_x(scene.acceleration, {limit, kKineticShare * limit});
  const auto held = end_along_x(laboratory, scene);
  scene.then(0.4, {-1.1 * limit, 0, 0});
  const SlidingBlock again = slide_along_x(scene.acceleration, {limit, kKineticShare * limit});
  const auto end = end_along_x(laboratory, scene);
  if (!held || !end) return {};
  return {relative("displacement after the stop (m)", held->displacement, stopped.displacement, ToleranceClass::fine),
          scaled("velocity after the stop (m/s)", held->velocity, 0.0, 1.0, ToleranceClass::exact),
          relative("displacement at the end (m)", end->displacement, again.displacement, ToleranceClass::fine)};
}

/// Vibration of 1 kHz, +A +A −A −A at 4 kHz, with A = 0.99 μg: always below the limit, so that the box is at rest.
std::vector<Measurement> slide_vibration(Laboratory& laboratory) {
  Scene scene = flat_box();
  const double amplitude = 0.99 * 0.5 * scene.settings.gravity;
  for (int quarter = 0; quarter < 240000; ++quarter)
    scene.acceleration.segments.push_back(
        {quarter / 4000.0, 1.0 / 4000.0, Vec3(quarter % 4 < 2 ? amplitude : -amplitude, 0, 0)});
  return {scaled("largest drift in 60 s (m)", largest_drift(laboratory, scene, 1.0), 0.0, 1.0, ToleranceClass::exact)};
}

/// Newmark's sliding block (Geotechnique 15, 1965): a sine of 1 Hz, divided into 48 intervals per cycle, plus a bias.
/// The reference is integrated in closed form, interval by interval. With A = 1.5 μg and no bias, the block slides
/// equally far forth and back in every cycle except the last, whose sliding ends during the rest that follows.
std::vector<Measurement> newmark_block(Laboratory& laboratory, double bias_share) {
  Scene scene = flat_box();
  const double limit = 0.5 * scene.settings.gravity;
  constexpr int kPieces = 48;
  for (int piece = 0; piece < 10 * kPieces; ++piece) {
    const double phase = 2.0 * std::numbers::pi * (piece % kPieces + 0.5) / kPieces;
    scene.acceleration.segments.push_back({static_cast<double>(piece) / kPieces, 1.0 / kPieces,
                                           Vec3(limit * (1.5 * std::sin(phase) + bias_share), 0, 0)});
  }
  scene.then(1.0, Vec3::Zero());
  const SlidingBlock block = slide_along_x(scene.acceleration, limit);
  const double moved = final_state(laboratory, scene).position[0].x() - scene.boxes[0].position.x();
  return {scaled("displacement over the path's length (m)", moved, block.displacement, block.distance,
                 ToleranceClass::good)};
}

/// A container that falls with more than g: the box rises relative to it, z = ½ (−a_z − g) t².
std::vector<Measurement> lift_off(Laboratory& laboratory) {
  Scene scene = flat_box();
  const double gravity = scene.settings.gravity;
  scene.then(0.5, {0, 0, -1.2 * gravity});
  const Snapshot end = final_state(laboratory, scene);
  return {relative("height (m)", end.position[0].z() - scene.boxes[0].position.z(), 0.5 * 0.2 * gravity * 0.25,
                   ToleranceClass::fine),
          scaled("turn (rad)", turn_of(end.orientation[0]), 0.0, 1.0, ToleranceClass::exact)};
}

/// Boxes on each other without friction all move by x = −½ a t² relative to the container: no torque acts on them.
std::vector<Measurement> frictionless(Laboratory& laboratory, int count) {
  Scene scene = empty_scene({60, 60, 10}, 0.0);
  for (int i = 0; i < count; ++i) {
    SceneBox box = standing_box({0.4, 0.4, 1.2}, {29.8, 29.8, 1.2 * i});
    box.mass = 10.0 * (1 + i % 3);
    scene.boxes.push_back(box);
  }
  const double acceleration = scene.settings.gravity;
  scene.then(1.0, {acceleration, 0, 0});
  const Snapshot end = final_state(laboratory, scene);
  double worst = 0.0;
  double turn = 0.0;
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const Vec3 exact = scene.boxes[i].position - Vec3(0.5 * acceleration, 0, 0);
    worst = std::max(worst, (end.position[i] - exact).norm());
    turn = std::max(turn, turn_of(end.orientation[i]));
  }
  return {
      scaled("largest error of a position over the path (m)", worst, 0.0, 0.5 * acceleration, ToleranceClass::exact),
      scaled("largest turn (rad)", turn, 0.0, 1.0, ToleranceClass::exact)};
}

/// μ = l/h: the contact force at the friction limit acts at the edge, so that the box slides without a tipping moment.
/// Rotation grows only from rounding, as e^(5 t).
std::vector<Measurement> doubly_degenerate(Laboratory& laboratory) {
  const auto moved = [&](double share, double& turn) {
    Scene scene = empty_scene({20, 20, 5}, 0.5);
    scene.boxes.push_back(standing_box({0.5, 0.5, 1.0}, {9.75, 9.75, 0}));
    scene.then(1.0, {share * 0.5 * scene.settings.gravity, 0, 0});
    const Snapshot end = final_state(laboratory, scene);
    turn = turn_of(end.orientation[0]);
    return (end.position[0] - scene.boxes[0].position).head<2>().norm();
  };
  // ½ 1e-3 · 0.5 · 9.81 · 1² = 2.45 mm
  double turn_below = 0.0;
  double turn_above = 0.0;
  const double below = moved(0.999, turn_below);
  const double above = moved(1.001, turn_above);
  return {verdict("rests at 0.999 of the limit", below < 1e-4 && turn_below < 1e-3, true),
          verdict("slides at 1.001 of it", above > 1.2e-3 && above < 5e-3, true),
          verdict("does not turn at 1.001 of it", turn_above < 1e-3, true)};
}

/// Flat boxes, one on the other: every interface has the limit μg, at any height.
std::vector<Measurement> stack_slides(Laboratory& laboratory, int count) {
  Scene scene = empty_scene({20, 20, 5}, 0.4);
  for (int i = 0; i < count; ++i) scene.boxes.push_back(standing_box({1.0, 1.0, 0.2}, {9.5, 9.5, 0.2 * i}));
  return slide_threshold(laboratory, scene, 0.4, Vec3::UnitX());
}

}  // namespace

std::vector<Case> slide_cases() {
  std::vector<Case> cases = {
      {"slide", "slide_path", "how far and how fast a box slides at 1.5 times its limit",
       "first-order time stepping lengthens the path by the factor 1 + h/t", true, slide_path},
      {"slide", "slide_near_limit_1e-3", "rest or sliding at 0.999 and 1.001 of the limit, 10 s",
       "soft contacts creep below the limit", true,
       [](Laboratory& laboratory) { return slide_near_limit(laboratory, 1e-3); }},
      {"slide", "slide_near_limit_1e-6", "the same, a thousand times closer to the limit",
       "single precision; a tolerance of the solver above the margin", true,
       [](Laboratory& laboratory) { return slide_near_limit(laboratory, 1e-6); }},
      {"slide", "slide_every_heading", "the same limit, and sliding in a straight line, in every heading",
       "a friction pyramid is up to 1.41 times too strong on the diagonals and changes the direction of sliding", false,
       slide_every_heading},
      {"slide", "slide_brake_pulse", "where a box stops after a brake pulse",
       "the box slides back in the step in which it stops", true,
       [](Laboratory& laboratory) { return slide_pulse(laboratory, 0.0, 0.5); }},
      {"slide", "slide_pulse_off_grid",
       "the same, when the pulse begins and ends and the box stops between ends of steps",
       "steps that contain the start or end of the pulse", true,
       [](Laboratory& laboratory) { return slide_pulse(laboratory, 0.1037, 0.4321); }},
      {"slide", "kinetic_start", "rest below the static limit, and sliding above it with less friction",
       "one coefficient for both", true, kinetic_start},
      {"slide", "kinetic_stops_and_holds",
       "a box that slides on where it would not have started, stops and holds again", "one coefficient for both", true,
       kinetic_stops_and_holds},
      {"slide", "slide_vibration", "rest under vibration of 1 kHz just below the limit",
       "friction of the last step in the warm start", false, slide_vibration},
      {"slide", "newmark_block", "no drift under a symmetric sine above the limit", "a bias towards one direction",
       false, [](Laboratory& laboratory) { return newmark_block(laboratory, 0.0); }},
      {"slide", "newmark_block_biased", "drift under a sine with a bias", "stops and starts spread over a step", false,
       [](Laboratory& laboratory) { return newmark_block(laboratory, 0.2); }},
      {"slide", "slide_lift_off", "height of a box over a floor that falls away", "the floor pulls on the box", true,
       lift_off},
      {"slide", "slide_frictionless", "path of a tall box without friction",
       "unequal forces at the corners rotate the box", true,
       [](Laboratory& laboratory) { return frictionless(laboratory, 1); }},
      {"slide", "slide_frictionless_tower", "five tall boxes without friction stay together",
       "unequal forces at the corners rotate the boxes", true,
       [](Laboratory& laboratory) { return frictionless(laboratory, 5); }},
      {"slide", "slide_doubly_degenerate", "a box with μ = l/h slides upright", "the box tips because of rounding",
       true, doubly_degenerate},
      {"slide", "slide_stack_5", "smallest acceleration that slides any of five boxes on each other",
       "friction that has not converged: stacks creep far below the limit", false,
       [](Laboratory& laboratory) { return stack_slides(laboratory, 5); }},
      {"slide", "slide_stack_10", "smallest acceleration that slides any of ten boxes on each other",
       "friction that has not converged: stacks creep far below the limit", false,
       [](Laboratory& laboratory) { return stack_slides(laboratory, 10); }},
  };
  for (const double heave : {-0.5, 0.5}) {
    cases.push_back(
        {"slide", fmt::format("slide_heave_{:+.1f}_g", heave),
         fmt::format("smallest acceleration that slides a box while the floor accelerates upwards with {:+.1f} g",
                     heave),
         "the normal force assumed to be m g", true, [=](Laboratory& laboratory) {
           const Scene scene = flat_box();
           return slide_threshold(laboratory, scene, 0.5, Vec3::UnitX(), heave * scene.settings.gravity);
         }});
  }
  for (const std::vector<Case>& part : {mixed_load_cases(), sliding_tests()})
    cases.insert(cases.end(), part.begin(), part.end());
  return cases;
}

}  // namespace holdfast::internal
