#include "validate/answers/twins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace holdfast::internal {

namespace {

constexpr double kSide = 16.0;
const Vec3 kFlat = {1.0, 1.0, 0.25};

SceneBox box_of(const Vec3& size, const Vec3& corner, double friction) {
  SceneBox box = standing_box(size, corner);
  box.mass = 256.0 * size.prod();
  box.friction = friction;
  return box;
}

}  // namespace

Scene slipping_stack() {
  Scene scene = empty_scene({kSide, kSide, kSide}, 0.0);
  scene.settings.container.friction = 1.0;
  // Products: 1 x 0.5, 0.5 x 0.6, 0.6 x 1/3.
  scene.boxes = {box_of(kFlat, {5.0, 5.0, 0.0}, 0.5), box_of(kFlat, {5.0, 5.0, 0.25}, 0.6),
                 box_of(kFlat, {5.0, 5.0, 0.5}, 1.0 / 3.0)};
  return scene;
}

Scene assorted_scene() {
  Scene scene = slipping_stack();
  // Tips along x from 0.25 g on, along y from 0.5 g on; does not slide.
  scene.boxes.push_back(box_of({0.25, 0.5, 1.0}, {10.0, 5.0, 0.0}, 1.0));
  scene.boxes.push_back(box_of(kFlat, {7.5, 9.5, 0.0}, 0.25));
  const double load = 0.5 * scene.settings.gravity;
  scene.then(0.5, {load * std::sqrt(0.75), 0.5 * load, 0.0});
  return scene;
}

Scene scaled_twin(const Scene& scene, double factor) {
  const double slower = std::sqrt(factor);
  Scene twin = scene;
  twin.settings.container.size *= factor;
  for (SceneBox& box : twin.boxes) {
    box.size *= factor;
    box.position *= factor;
    box.velocity *= slower;
    box.angular_velocity /= slower;
  }
  for (Segment& segment : twin.acceleration.segments) {
    segment.start *= slower;
    segment.duration *= slower;
  }
  twin.step_factor *= slower;
  return twin;
}

Scene heavier_twin(const Scene& scene, double factor) {
  Scene twin = scene;
  for (SceneBox& box : twin.boxes) box.mass *= factor;
  return twin;
}

Scene mirrored_twin(const Scene& scene, int axis) {
  Scene twin = scene;
  for (SceneBox& box : twin.boxes) box.position[axis] = scene.settings.container.size[axis] - box.position[axis];
  for (Segment& segment : twin.acceleration.segments) segment.acceleration[axis] = -segment.acceleration[axis];
  return twin;
}

Scene swapped_twin(const Scene& scene) {
  const auto swap = [](Vec3& v) { std::swap(v.x(), v.y()); };
  Scene twin = scene;
  swap(twin.settings.container.size);
  for (SceneBox& box : twin.boxes) {
    swap(box.size);
    swap(box.position);
  }
  for (Segment& segment : twin.acceleration.segments) swap(segment.acceleration);
  return twin;
}

Scene reversed_twin(const Scene& scene) {
  Scene twin = scene;
  std::reverse(twin.boxes.begin(), twin.boxes.end());
  return twin;
}

double distance_between(const Snapshot& a, const Snapshot& b) {
  if (a.position.size() != b.position.size() || a.position.empty()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.position.size(); ++i)
    largest = std::max(largest, (a.position[i] - b.position[i]).norm());
  return largest;
}

bool same_bits(const Snapshot& a, const Snapshot& b) {
  const auto hash = [](const Snapshot& s) {
    return state_hash({s.position, s.orientation, s.velocity, s.angular_velocity});
  };
  return !a.position.empty() && a.position.size() == b.position.size() && hash(a) == hash(b);
}

}  // namespace holdfast::internal
