#include "validate/answers/dominoes.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace holdfast::internal {

namespace {

constexpr int kCount = 14;
constexpr double kPitch = 0.5;  // of the height
constexpr std::size_t kFrom = 3;
constexpr std::size_t kTo = 10;

}  // namespace

Scene domino_row(double height) {
  const double thickness = height / 8.0;
  Scene scene = empty_scene({20.0 * height, 10.0 * height, 10.0 * height}, 0.5);
  for (int i = 0; i < kCount; ++i)
    scene.boxes.push_back(
        standing_box({thickness, 0.5 * height, height}, {height * (4.0 + kPitch * i), 5.0 * height, 0.0}));
  // Rotation about the edge: v = ω × r, r from the edge to the centre.
  const double spin = 3.0 * std::sqrt(0.25 / height);
  scene.boxes[0].angular_velocity = {0.0, spin, 0.0};
  scene.boxes[0].velocity = {0.5 * height * spin, 0.0, 0.5 * thickness * spin};
  scene.then(8.0 * std::sqrt(height), {0, 0, 0});
  return scene;
}

double domino_speed(Laboratory& laboratory, double height) {
  constexpr double kTilted = std::numbers::pi / 180.0;
  const Scene scene = domino_row(height);
  double reached[2] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  double before[2] = {0.0, 0.0};
  laboratory.run(scene, [&](const Moment& moment) {
    const std::size_t watched[2] = {kFrom, kTo};
    for (int i = 0; i < 2; ++i) {
      const double tilt = turn_of(moment.state.orientation[watched[i]]);
      if (std::isnan(reached[i]) && tilt >= kTilted)
        reached[i] = moment.time - moment.step * (tilt - kTilted) / (tilt - before[i]);
      before[i] = tilt;
    }
    return std::isnan(reached[1]);
  });
  return kPitch * height * static_cast<double>(kTo - kFrom) / (reached[1] - reached[0]);
}

}  // namespace holdfast::internal
