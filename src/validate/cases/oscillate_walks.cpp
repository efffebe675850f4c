#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "validate/answers/sampled_wave.hpp"
#include "validate/answers/stick_slip.hpp"
#include "validate/cases/oscillate_cases.hpp"

namespace holdfast::internal {

namespace {

constexpr double kGravity = kOscillateGravity;
constexpr double kFriction = 0.5;
const Vec3 kContainer = {30, 30, 5};
const Vec3 kBox = {1.0, 0.8, 0.3};

/// A vibration that moves a box by micrometres per cycle: along y mean + shake sin(2πft), along z heave
/// sin(2πft + phase), or along x across sin(2πft), in units of g.
struct Walk {
  double frequency = 1.0;  ///< Hz
  double rate = 1000.0;    ///< samples per second
  double mean = 0.0;
  double shake = 0.0;
  double heave = 0.0;
  double phase = 0.0;  ///< rad
  double across = 0.0;
  double duration = 10.0;       ///< of one box, s
  double group_duration = 0.0;  ///< of several boxes, s; 0: only one box
};

/// In each cycle the box slides while |a_y| > μ (g + a_z), and stops again.
constexpr Walk kWalks[] = {
    {.frequency = 5, .rate = 100, .mean = 0.15, .shake = 0.45, .heave = 0.1, .phase = 1.0, .group_duration = 3.0},
    {.frequency = 20, .mean = 0.15, .shake = 0.3, .heave = 0.3, .phase = 2.0, .group_duration = 5.0},
    {.frequency = 50, .mean = 0.35, .heave = 0.4},
    {.frequency = 100, .mean = 0.3, .shake = 0.5, .group_duration = 3.0},
    {.frequency = 200, .rate = 2000, .mean = 0.3, .shake = 0.5, .duration = 4.0},
    {.frequency = 5, .rate = 100, .mean = 0.2, .across = 0.75, .group_duration = 3.0},
    {.frequency = 30, .mean = 0.15, .across = 1.0, .group_duration = 3.0},
    {.frequency = 90, .mean = 0.35, .across = 0.55},
};

Acceleration acceleration_of(const Walk& walk, double duration) {
  Oscillation oscillation = {walk.mean * kGravity * Vec3::UnitY(), {}};
  oscillation.waves.push_back({walk.shake * kGravity * Vec3::UnitY(), walk.frequency, 0.0});
  oscillation.waves.push_back({walk.heave * kGravity * Vec3::UnitZ(), walk.frequency, walk.phase});
  oscillation.waves.push_back({walk.across * kGravity * Vec3::UnitX(), walk.frequency, 0.0});
  return sampled(oscillation, duration, walk.rate);
}

/// `along_x` times `along_y` boxes on the floor, in the middle of the container.
/// @param gap between neighbours, m
Scene side_by_side(int along_x, int along_y, double gap) {
  Scene scene = empty_scene(kContainer, kFriction);
  const Vec3 pitch = kBox + gap * Vec3::Ones();
  const double x = 0.5 * (kContainer.x() - along_x * pitch.x());
  const double y = 0.5 * (kContainer.y() - along_y * pitch.y());
  for (int i = 0; i < along_x; ++i)
    for (int j = 0; j < along_y; ++j)
      scene.boxes.push_back(standing_box(kBox, {x + i * pitch.x(), y + j * pitch.y(), 0.0}));
  return scene;
}

/// The boxes slide alike, each on the floor alone or on one that it moves with: neighbours that touch do not push, and
/// a tower neither slips, at friction 1.5, nor tips, at a height of 0.9 m on a depth of 0.8 m. The path is that of one
/// block, piecewise in closed form (`slide_along`), or integrated where the slip turns (`slide_over`).
std::vector<Measurement> walked(Laboratory& laboratory, Scene scene, const Walk& walk, double duration) {
  scene.acceleration = acceleration_of(walk, duration);
  const SlidePath path = walk.across == 0.0 ? slide_along(1, scene.acceleration, kFriction, kGravity)
                                            : slide_over(scene.acceleration, kFriction, kGravity);
  return moved_as_one(laboratory, scene, path.displacement, std::abs(path.displacement.y()), ToleranceClass::coarse);
}

/// A shock of 8 g and 5 ms along y, and a constant acceleration before, during and after it.
struct Shock {
  bool half_sine = false;  ///< otherwise rectangular
  double rate = 1000.0;    ///< samples per second of the whole acceleration
  double bias = 0.0;       ///< the constant acceleration, g
};

constexpr double kShockLength = 0.005;  // s

/// @param begin of the shock, s
Acceleration acceleration_of(const Shock& shock, double begin, double duration) {
  const double peak = 8.0 * kGravity;
  // The half sine is a sine of the whole acceleration, cut to the shock: the mean of each sample's interval is exact.
  const double pulsation = std::numbers::pi / kShockLength;
  const Oscillation sine = {Vec3::Zero(), {{peak * Vec3::UnitY(), 0.5 / kShockLength, -pulsation * begin}}};
  Acceleration acceleration = sampled(sine, duration, shock.rate);
  for (Segment& segment : acceleration.segments) {
    const double middle = segment.start + 0.5 * segment.duration;
    const bool within = middle > begin && middle < begin + kShockLength;
    if (!within) segment.acceleration.setZero();
    if (within && !shock.half_sine) segment.acceleration = peak * Vec3::UnitY();
    segment.acceleration.y() += shock.bias * kGravity;
  }
  return acceleration;
}

/// The part of an acceleration before a time.
Acceleration until(const Acceleration& acceleration, double time) {
  Acceleration part;
  for (const Segment& segment : acceleration.segments) {
    if (segment.start >= time - kSameInstant) break;
    part.segments.push_back(segment);
    part.segments.back().duration = std::min(segment.duration, time - segment.start);
  }
  return part;
}

/// A number of a run and the exact one.
struct Found {
  double value = 0.0;
  double expected = 0.0;

  double error() const { return std::abs(value / expected - 1.0); }
};

/// What a shock gives the box: its velocity at the first end of a step after the shock, m/s, and its displacement at
/// the end, m. The exact ones of the same times are those of `slide_along`.
std::pair<Found, Found> after_shock(Laboratory& laboratory, const Shock& shock, double begin) {
  Scene scene = side_by_side(1, 1, 0.0);
  scene.acceleration = acceleration_of(shock, begin, shock.bias == 0.0 ? 0.3 : 0.5);
  double time = 0.0;
  Found velocity;
  Found moved;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    moved.value = moment.state.position[0].y() - scene.boxes[0].position.y();
    if (time != 0.0 || moment.time < begin + kShockLength - kSameInstant) return true;
    time = moment.time;
    velocity.value = moment.state.velocity[0].y();
    return true;
  });
  if (outcome.stop_reason == StopReason::failed)
    moved.value = velocity.value = std::numeric_limits<double>::quiet_NaN();
  velocity.expected = slide_along(1, until(scene.acceleration, time), kFriction, kGravity).velocity.y();
  moved.expected = slide_along(1, scene.acceleration, kFriction, kGravity).displacement.y();
  return {velocity, moved};
}

/// A shock gives the box ∫ (|a| − μ g) dt over the time in which it slides, and friction stops it afterwards. Of five
/// shocks that begin at different times within a step of 60 per second, the one with the largest error counts.
std::vector<Measurement> shocked(Laboratory& laboratory, const Shock& shock) {
  Found velocity;
  Found moved;
  for (int i = 0; i < 5; ++i) {
    const auto [speed, way] = after_shock(laboratory, shock, 0.1 + 0.003 * i);
    if (i == 0 || !(speed.error() <= velocity.error())) velocity = speed;
    if (i == 0 || !(way.error() <= moved.error())) moved = way;
  }
  return {relative("velocity after the shock, worst of five (m/s)", velocity.value, velocity.expected,
                   ToleranceClass::coarse),
          relative("displacement, worst of five (m)", moved.value, moved.expected, ToleranceClass::coarse)};
}

void add_walks(std::vector<Case>& cases) {
  const char* const mean = "the mean of several samples hides the peaks that exceed friction";
  for (const Walk& walk : kWalks) {
    const bool turns = walk.across > 0.0;
    const std::string name = fmt::format("walk_{}_hz{}", walk.frequency, turns ? "_across" : "");
    const auto add = [&](const std::string& who, const std::string& what, const char* failure_mode, bool quick,
                         double duration, const Scene& scene) {
      cases.push_back(
          {"oscillate", name + who,
           fmt::format("path of {} under a vibration of {} Hz{}", what, walk.frequency,
                       turns ? " across a steady acceleration" : ""),
           turns ? "friction keeps its direction through a step in which the slip turns" : failure_mode, quick,
           [scene, walk, duration](Laboratory& laboratory) { return walked(laboratory, scene, walk, duration); }});
    };
    add("", "a box", mean, true, walk.duration, side_by_side(1, 1, 0.0));
    if (walk.group_duration == 0.0) continue;
    add("_20_side_by_side", "20 boxes that do not touch", mean, false, walk.group_duration, side_by_side(5, 4, 0.1));
    add("_row_of_12_across", "a row of 12 boxes that touch, across the vibration",
        "friction between faces that only touch", false, walk.group_duration, side_by_side(12, 1, 0.0));
    add("_row_of_12_along", "a row of 12 boxes that touch, along the vibration",
        "forces between boxes that only touch; boxes that are followed one by one separate", false, walk.group_duration,
        side_by_side(1, 12, 0.0));
    add("_tower_of_3", "a tower of three boxes that moves as one", "only boxes on the floor are followed",
        walk.frequency == 100, walk.group_duration, tower(3, kBox, kFriction, 1.5));
  }
}

void add_shocks(std::vector<Case>& cases) {
  for (const Shock& shock :
       {Shock{false, 1000.0, 0.0}, Shock{true, 1000.0, 0.0}, Shock{true, 5000.0, 0.0}, Shock{true, 2000.0, 0.4}}) {
    const char* const shape = shock.half_sine ? "half_sine" : "rectangle";
    const std::string biased = shock.bias == 0.0 ? "" : fmt::format("_at_{}_g", shock.bias);
    cases.push_back({"oscillate", fmt::format("shock_{}_{}_per_s{}", shape, shock.rate, biased),
                     fmt::format("speed and path after a shock of 8 g and 5 ms, {} samples per second{}", shock.rate,
                                 shock.bias == 0.0 ? "" : ", while friction is nearly used up"),
                     "a shock that is shorter than a step is spread over it", true,
                     [shock](Laboratory& laboratory) { return shocked(laboratory, shock); }});
  }
}

}  // namespace

std::vector<Case> walk_cases() {
  std::vector<Case> cases;
  add_walks(cases);
  add_shocks(cases);
  return cases;
}

}  // namespace holdfast::internal
