#include <fmt/format.h>

#include <cmath>

#include "validate/cases/hard_cases.hpp"
#include "validate/laboratory/departure.hpp"

namespace holdfast::internal {

namespace {

constexpr double kHeight = 2.2;   ///< of the columns, m
constexpr double kSettled = 0.5;  ///< of gravity alone before the acceleration, s
constexpr double kSeconds = 1.0;  ///< under the acceleration

/// A column of `count` equal boxes between floor and roof, with a clearance above it, under an acceleration along x.
Scene column(int count, double length, double play, double friction, double acceleration) {
  Scene scene = empty_scene({20.0, 20.0, kHeight + play}, friction);
  const double height = kHeight / count;
  for (int i = 0; i < count; ++i) scene.boxes.push_back(standing_box({length, 1.5, height}, {9.0, 9.0, i * height}));
  scene.then(kSettled, {0, 0, 0}).then(kSeconds, {acceleration, 0, 0});
  return scene;
}

double path_of(Laboratory& laboratory, const Scene& scene) {
  return scene.boxes.front().position.x() - final_state(laboratory, scene).position.front().x();
}

/// Friction 0.4 is below length over height: the column slides and does not tip, so that it never presses against the
/// roof. Its path is ½ (a − μg) t² for every clearance.
std::vector<Measurement> sliding_column(Laboratory& laboratory, int count, double length, double play) {
  constexpr double kFriction = 0.4;
  constexpr double kAcceleration = 5.1;
  const Scene scene = column(count, length, play, kFriction, kAcceleration);
  const double expected = 0.5 * (kAcceleration - kFriction * scene.settings.gravity) * kSeconds * kSeconds;
  return {relative("path (m)", path_of(laboratory, scene), expected, ToleranceClass::good)};
}

/// Friction 0.5 is above length over height: the column tilts and is wedged between its front edge below and its rear
/// edge above. While both slide, the moments about its centre of mass give the normal force of the roof:
///   N = m g (μ h − l) / (2 l)
/// The friction of both, μ (m g + 2 N), is m g μ² h / l. Up to this force the column holds; above it, it slides by
/// ½ (a − g μ² h / l) t², minus the delay of tilting through the clearance.
std::vector<Measurement> wedged_column(Laboratory& laboratory, double play, double share) {
  constexpr double kFriction = 0.5;
  constexpr double kLength = 1.0;
  Scene scene = column(2, kLength, play, kFriction, 0.0);
  const double limit = kFriction * kFriction * scene.settings.gravity * kHeight / kLength;
  scene.acceleration.segments.back().acceleration.x() = share * limit;
  const double path = path_of(laboratory, scene);
  constexpr double kMoved = 0.01;
  if (share < 1.0) return {verdict("moves 1 cm", std::abs(path) > kMoved, false)};
  return {relative("path (m)", path, 0.5 * (share - 1.0) * limit * kSeconds * kSeconds, ToleranceClass::coarse)};
}

/// A beam on two different supports that carry different weights, friction 0.2 everywhere. All boxes slide together at
/// μg. At any smaller acceleration, friction can be distributed so that every box is in balance; near the limit this
/// distribution is unique.
std::vector<Measurement> bridge(Laboratory& laboratory, double share) {
  constexpr double kFriction = 0.2;
  Scene scene = empty_scene({20.0, 20.0, 10.0}, kFriction);
  scene.boxes = {standing_box({0.9981, 1.0, 0.8}, {9.0, 9.0, 0.0}),
                 standing_box({0.3511, 1.0, 0.8}, {10.2114, 9.0, 0.0}),
                 standing_box({1.3031, 1.0, 0.8}, {8.9407, 9.0, 0.8})};
  scene.boxes[0].mass = 79.9;
  scene.boxes[1].mass = 280.9;
  scene.boxes[2].mass = 1042.4;
  scene.then(kSettled, {0, 0, 0}).then(kSeconds, {share * kFriction * scene.settings.gravity, 0, 0});
  constexpr double kMoved = 0.005;
  return {verdict("moves 5 mm", departure(laboratory, scene, kSettled, kMoved) > kMoved, share > 1.0)};
}

struct Play {
  const char* name;
  double size;  ///< m
};
constexpr Play kPlays[] = {{"0", 0.0}, {"1um", 1e-6}, {"100um", 1e-4}, {"1mm", 1e-3}};

}  // namespace

std::vector<Case> hard_roof_cases() {
  std::vector<Case> cases;
  const std::string failure_mode = "the column is clamped between floor and roof by forces that nothing causes";
  for (const Play& play : kPlays) {
    for (const auto& [count, length] : {std::pair(1, 1.2), std::pair(4, 1.0)})
      cases.push_back(
          {"hard", fmt::format("roof_slide_{}_play_{}", count, play.name),
           "how far a column slides that exactly fits under the roof", failure_mode, true,
           [=, count = count, length = length](Laboratory& l) { return sliding_column(l, count, length, play.size); }});
    for (const double share : {0.97, 1.5})
      cases.push_back({"hard", fmt::format("roof_wedge_{:g}_play_{}", share, play.name),
                       "whether a column that tilts under the roof is wedged there, or how far it slides", failure_mode,
                       true, [=](Laboratory& l) { return wedged_column(l, play.size, share); }});
  }
  for (const double share : {0.9, 0.95, 0.99, 1.01})
    cases.push_back({"hard", fmt::format("bridge_{:g}", share), "whether a beam on two different supports stays",
                     "forces that balance the boxes exist, and are not found", true,
                     [=](Laboratory& l) { return bridge(l, share); }});
  return cases;
}

}  // namespace holdfast::internal
