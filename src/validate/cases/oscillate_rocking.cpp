#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "validate/answers/rocking_trains.hpp"
#include "validate/cases/oscillate_cases.hpp"

namespace holdfast::internal {

namespace {

/// Friction so high that nothing slides: Housner's block does not.
constexpr double kFirm = 3.0;

/// A block alone on a large floor, under a train.
Scene block_under(const RockingTrain& train, const Vec3& size) {
  Scene scene = empty_scene({20, 20, 5}, kFirm);
  scene.boxes.push_back(standing_box(size, {10.0 - 0.5 * size.x(), 10.0 - 0.5 * size.y(), 0.0}));
  scene.acceleration = acceleration_of(train, size, kOscillateGravity);
  return scene;
}

/// The largest tilt of the block at any end of a step, rad; the run ends where it is beyond `enough`. Not a number if
/// the run failed.
double measured_tilt(Laboratory& laboratory, const Scene& scene, double enough) {
  double largest = 0.0;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    largest = std::max(largest, turn_of(moment.state.orientation[0]));
    return largest <= enough;
  });
  return outcome.stop_reason == StopReason::failed ? std::numeric_limits<double>::quiet_NaN() : largest;
}

/// The number of trains that the engine answers wrongly, where none is right. A run that failed is wrong.
Measurement wrong(const char* metric, Laboratory& laboratory, const Vec3& size, std::span<const RockingTrain> trains,
                  int cycles, bool falls) {
  int count = 0;
  for (const RockingTrain& train : trains) {
    if (train.cycles != cycles) continue;
    const double tilt = measured_tilt(laboratory, block_under(train, size), kFallenTilt);
    if (falls ? !(tilt > kFallenTilt) : !(tilt <= kFallenTilt)) ++count;
  }
  return scaled(metric, count, 0.0, 1.0, ToleranceClass::verdict);
}

/// Trains whose answer by Housner's equation with impacts is the same at every amplitude within 3 % of theirs, by the
/// largest tilt during the train and the two seconds after it: more than 10 degrees, or not.
std::vector<Measurement> overturned(Laboratory& laboratory, const RockingTrains& trains, int cycles) {
  return {
      wrong("trains that overturn it and do not here", laboratory, trains.size, trains.falling, cycles, true),
      wrong("trains that leave it standing and do not here", laboratory, trains.size, trains.standing, cycles, false)};
}

/// Trains that tilt the block by some degrees without overturning it, and whose largest tilt depends little on the
/// amplitude: it is within 30 % at every amplitude within 3 % of theirs. By Housner's equation with impacts.
std::vector<Measurement> swung(Laboratory& laboratory, const RockingTrains& trains) {
  std::vector<Measurement> measurements;
  for (const RockingTrain& train : trains.swinging) {
    const double tilt = measured_tilt(laboratory, block_under(train, trains.size), M_PI);
    measurements.push_back(relative(
        fmt::format("largest tilt, {} x {} s at {} of the limit (rad)", train.cycles, train.period, train.amplitude),
        tilt, largest_tilt(train, trains.size, kOscillateGravity), ToleranceClass::coarse));
  }
  return measurements;
}

}  // namespace

std::vector<Case> rocking_train_cases() {
  std::vector<Case> cases;
  for (const RockingTrains& trains : rocking_trains()) {
    const bool first = &trains == &rocking_trains().front();
    const Vec3 cm = 100.0 * trains.size;
    const std::string block = fmt::format("{:.0f}x{:.0f}x{:.0f}", cm.x(), cm.y(), cm.z());
    for (const int cycles : {1, 2, 4, 8})
      cases.push_back({"oscillate", fmt::format("rocking_{}_cycles_{}", block, cycles),
                       fmt::format("whether trains of {} sine cycles overturn a block of {} cm", cycles, block),
                       "impacts on the other edge lose too much or too little energy when they are slow",
                       cycles == 1 || (first && cycles < 8),
                       [&trains, cycles](Laboratory& laboratory) { return overturned(laboratory, trains, cycles); }});
    cases.push_back({"oscillate", fmt::format("rocking_{}_tilt", block),
                     fmt::format("how far sine cycles tilt a block of {} cm that they do not overturn", block),
                     "the same, step by step: a block that rocks less or more than it should", first,
                     [&trains](Laboratory& laboratory) { return swung(laboratory, trains); }});
  }
  return cases;
}

}  // namespace holdfast::internal
