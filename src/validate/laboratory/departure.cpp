#include "validate/laboratory/departure.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace holdfast::internal {

namespace {

constexpr double kLost = std::numeric_limits<double>::infinity();

}  // namespace

double departure(Laboratory& laboratory, const Scene& scene, double from, double enough) {
  std::vector<Vec3> origin;
  double largest = 0.0;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    if (moment.time < from - kSameInstant) return true;
    if (origin.empty()) origin.assign(moment.state.position.begin(), moment.state.position.end());
    for (std::size_t i = 0; i < origin.size(); ++i)
      largest = std::max(largest, (moment.state.position[i] - origin[i]).norm());
    return largest <= enough;
  });
  return outcome.stop_reason == StopReason::failed ? kLost : largest;
}

double smallest_load_that_moves(Laboratory& laboratory, const Scene& scene, double distance, double duration,
                                double low, double high, double precision) {
  const double from = scene.acceleration.end_time();
  return smallest_amplitude(low, high, precision, [&](double load) {
    Scene loaded = scene;
    loaded.then(duration, {load, 0, 0});
    return departure(laboratory, loaded, from, distance) > distance;
  });
}

std::vector<Measurement> rest_of(Laboratory& laboratory, const Scene& scene) {
  constexpr double kGone = 0.1;
  double largest = 0.0;
  double turn = 0.0;
  double speed = 0.0;
  const Outcome outcome = laboratory.run(scene, [&](const Moment& moment) {
    speed = 0.0;
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
      largest = std::max(largest, (moment.state.position[i] - scene.boxes[i].position).norm());
      const Rotation back = scene.boxes[i].orientation.conjugate();
      turn = std::max(turn, turn_of(back * moment.state.orientation[i]));
      speed = std::max(speed, moment.state.velocity[i].norm());
    }
    return largest < kGone;
  });
  if (outcome.stop_reason == StopReason::failed) largest = turn = speed = kLost;
  return {scaled("largest displacement (m)", largest, 0.0, 1.0, ToleranceClass::exact),
          scaled("largest turn (rad)", turn, 0.0, 1.0, ToleranceClass::exact),
          scaled("speed at the end (m/s)", speed, 0.0, 1.0, ToleranceClass::exact)};
}

}  // namespace holdfast::internal
