#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "validate/answers/sampled_wave.hpp"
#include "validate/answers/stick_slip.hpp"
#include "validate/cases/oscillate_cases.hpp"
#include "validate/laboratory/departure.hpp"

namespace holdfast::internal {

namespace {

using enum ToleranceClass;

constexpr double kGravity = kOscillateGravity;
constexpr double kFriction = 0.5;

/// A ship in waves: roll and heave of 5 to 15 s, stored 20 times per second.
Acceleration sea(std::uint64_t seed, double duration) {
  return sampled({Vec3::Zero(), noise(seed, 8, 1.0 / 15.0, 0.2, kGravity * Vec3(0.0, 0.2, 0.1))}, duration, 20.0);
}

/// A lorry in a bend on a bad road: 0.2 g to the side, and vibration of 1 to 40 Hz across and along z.
Acceleration lorry(std::uint64_t seed, double duration, double rate) {
  return sampled({0.2 * kGravity * Vec3::UnitY(), noise(seed, 24, 1.0, 40.0, kGravity * Vec3(0.0, 0.16, 0.16))},
                 duration, rate);
}

/// A box under noise that exceeds friction now and then, compared with the exact stick-slip path (`slide_along`).
/// Errors are relative to the length of the path.
std::vector<Measurement> slid(Laboratory& laboratory, const Acceleration& acceleration, double kinetic_share,
                              ToleranceClass tolerance) {
  Scene scene = tower(1, {1.0, 0.8, 0.3}, kFriction, kFriction);
  scene.settings.contact.kinetic_friction = kinetic_share;
  scene.acceleration = acceleration;
  const SlidePath path = slide_along(1, acceleration, kFriction, kGravity, 0.0, kinetic_share);
  return moved_as_one(laboratory, scene, path.displacement, path.distance, tolerance);
}

/// A stack of three rests under noise in all directions of which no sample uses up more than 0.98 of what friction
/// holds or of what tips it: the horizontal accelerations are scaled to that. The whole stack is what tips first.
std::vector<Measurement> rested(Laboratory& laboratory, double friction, double rate) {
  constexpr double kUse = 0.98;
  const Vec3 size = {0.6, 0.5, 0.3};
  Scene scene = tower(3, size, friction, friction);
  scene.acceleration = sampled({Vec3::Zero(), noise(11, 24, 1.0, 40.0, kGravity * Vec3(0.1, 0.1, 0.1))}, 3.0, rate);
  const double height = 3.0 * size.z();
  const Hold hold = {friction, size.x() / height, size.y() / height};
  const double factor = kUse / largest_use(scene.acceleration, hold, kGravity);
  for (Segment& segment : scene.acceleration.segments) segment.acceleration.head<2>() *= factor;
  return rest_of(laboratory, scene);
}

}  // namespace

std::vector<Case> noise_cases() {
  std::vector<Case> cases;
  const auto add = [&](std::string name, std::string question, const char* failure_mode, bool quick, auto measure) {
    cases.push_back({"oscillate", std::move(name), std::move(question), failure_mode, quick, measure});
  };
  const char* const events = "starts and stops that are not located in time; peaks lost in a mean of samples";
  for (const auto& [share, name] : {std::pair(1.0, ""), {0.75, "_kinetic_0.75"}}) {
    add(fmt::format("sea{}", name), "path of a box that a ship's motion moves now and then", events, true,
        [share = share](Laboratory& l) { return slid(l, sea(3, 60.0), share, good); });
    for (const double rate : {200.0, 1000.0})
      add(fmt::format("lorry_{}_per_s{}", rate, name),
          fmt::format("path of a box that a lorry's vibration moves now and then, {} samples per second", rate), events,
          rate == 1000.0, [=, share = share](Laboratory& l) { return slid(l, lorry(2, 10.0, rate), share, coarse); });
  }
  for (const double rate : {100.0, 1000.0}) {
    add(fmt::format("rest_in_noise_friction_{}_per_s", rate),
        "rest of a stack of three in noise that never exceeds 0.98 of its friction", "creep below the limit", true,
        [=](Laboratory& l) { return rested(l, 0.4, rate); });
    add(fmt::format("rest_in_noise_balance_{}_per_s", rate),
        "rest of a stack of three in noise that never exceeds 0.98 of what tips it", "rocking below the limit", true,
        [=](Laboratory& l) { return rested(l, 2.0, rate); });
  }
  return cases;
}

}  // namespace holdfast::internal
