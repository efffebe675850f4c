#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "validate/answers/sampled_wave.hpp"
#include "validate/answers/stick_slip.hpp"
#include "validate/cases/oscillate_cases.hpp"

namespace holdfast::internal {

namespace {

using enum ToleranceClass;

constexpr double kGravity = kOscillateGravity;
constexpr double kStatic = 0.5;
constexpr double kShare = 0.75;  ///< of static friction that is left while boxes slide

/// A sine along y about a mean, both in units of g.
Acceleration sine(double frequency, double mean, double amplitude, double duration, double rate) {
  return sampled({mean * kGravity * Vec3::UnitY(), {{amplitude * kGravity * Vec3::UnitY(), frequency, 0.0}}}, duration,
                 rate);
}

/// Rises within a second to `share` of the static limit, sample by sample, and stays there for a second.
Acceleration ramp(double share, double rate) {
  Acceleration acceleration;
  const double most = share * kStatic * kGravity;
  for (double i = 0.0; i < rate; ++i)
    acceleration.segments.push_back({i / rate, 1.0 / rate, most * (i + 0.5) / rate * Vec3::UnitY()});
  acceleration.segments.push_back({1.0, 1.0, most * Vec3::UnitY()});
  return acceleration;
}

/// Low boxes on each other, which neither slip on each other, at friction 1.5, nor tip, at a height of at most 1 m on a
/// depth of 1 m: they move as one block (`slide_along` with a kinetic share). Engines with one coefficient are not
/// measured.
std::vector<Measurement> slid_as_one(Laboratory& laboratory, std::size_t count, const Acceleration& acceleration,
                                     ToleranceClass tolerance) {
  Scene scene = tower(count, {1.0, 1.0, 0.1}, kStatic, 1.5);
  scene.settings.contact.kinetic_friction = kShare;
  scene.acceleration = acceleration;
  const SlidePath path = slide_along(1, acceleration, kStatic, kGravity, 0.0, kShare);
  return moved_as_one(laboratory, scene, path.displacement, path.distance, tolerance);
}

/// A small box on a wide flat one of four times its mass, compared with the exact paths (`slide_stacked` with a kinetic
/// share). The two contacts break at different accelerations, so that the answer is unique.
std::vector<Measurement> box_on_box(Laboratory& laboratory, double floor_friction, double upper_friction) {
  Scene scene = scene_of_pairs({64, 64, 4}, floor_friction, upper_friction, 0.0);
  scene.settings.contact.kinetic_friction = kShare;
  scene.boxes = {standing_box({8.0, 2.0, 0.2}, {28.0, 31.0, 0}), standing_box({0.5, 0.5, 0.1}, {31.75, 31.75, 0.2})};
  scene.boxes[0].mass = 400.0;
  scene.boxes[1].mass = 100.0;
  scene.acceleration =
      sampled({0.1 * kGravity * Vec3::UnitX(), {{0.6 * kGravity * Vec3::UnitX(), 1.0, 0.0}}}, 4.0, 100);
  const StackedPaths paths =
      slide_stacked(scene.acceleration, {400.0, 100.0, floor_friction, upper_friction, kGravity, kShare});
  const std::optional<Snapshot> end = final_state_if_any(laboratory, scene);
  if (!end) return {};
  const auto moved = [&](std::size_t i) { return end->position[i].x() - scene.boxes[i].position.x(); };
  return {scaled("displacement of the lower one (m)", moved(0), paths.lower, std::abs(paths.upper), coarse),
          scaled("displacement of the upper one (m)", moved(1), paths.upper, std::abs(paths.upper), coarse)};
}

}  // namespace

std::vector<Case> kinetic_cases() {
  std::vector<Case> cases;
  const auto add = [&](std::string name, std::string question, const char* failure_mode, bool quick, auto measure) {
    cases.push_back({"oscillate", std::move(name), std::move(question), failure_mode, quick, measure});
  };
  const char* const late = "kinetic friction begins after some sliding, and not when balance is lost";
  for (const auto& [count, name] : {std::pair(1, "box"), {3, "tower_of_3"}, {10, "tower_of_10"}}) {
    // The exact motion is a parabola; a tower's parts exchange forces, which a solver finds to its tolerance.
    const ToleranceClass tolerance = count == 1 ? fine : good;
    for (const double share : {1.001, 1.01, 1.04})
      add(fmt::format("kinetic_ramp_{}_{}", share, name),
          fmt::format("path of a {} when the acceleration rises to {} of the static limit and stays there",
                      count == 1 ? "box" : fmt::format("tower of {}", count), share),
          late, count < 10 || share == 1.01, [=, n = static_cast<std::size_t>(count)](Laboratory& l) {
            return slid_as_one(l, n, ramp(share, 100), tolerance);
          });
  }
  add("kinetic_ramp_1.01_box_1000_per_s", "the same for a box and 1,000 samples per second", late, true,
      [](Laboratory& l) { return slid_as_one(l, 1, ramp(1.01, 1000), good); });
  add("kinetic_sine_100_hz", "path of a box that 100 Hz set off and that then slides on", late, true,
      [](Laboratory& l) { return slid_as_one(l, 1, sine(100.0, 0.4, 0.15, 4.0, 1000), coarse); });
  add("kinetic_sine_100_hz_tower_of_3", "the same of a tower of three", late, false,
      [](Laboratory& l) { return slid_as_one(l, 3, sine(100.0, 0.4, 0.15, 4.0, 1000), coarse); });
  add("kinetic_stick_slip_box", "path of a box that sticks and slips under a sine of 2 Hz", late, true,
      [](Laboratory& l) { return slid_as_one(l, 1, sine(2.0, 0.1, 0.45, 4.0, 100), good); });
  add("kinetic_stick_slip_tower_of_3", "the same of a tower of three", late, true,
      [](Laboratory& l) { return slid_as_one(l, 3, sine(2.0, 0.1, 0.45, 4.0, 100), coarse); });
  add("kinetic_box_on_box_both", "paths of a box on a box under a sine of 1 Hz: both stick and slip", late, true,
      [](Laboratory& l) { return box_on_box(l, 0.4, 0.25); });
  add("kinetic_box_on_box_together", "paths of a box on a box under a sine of 1 Hz: they stay together", late, false,
      [](Laboratory& l) { return box_on_box(l, 0.4, 0.6); });
  return cases;
}

}  // namespace holdfast::internal
