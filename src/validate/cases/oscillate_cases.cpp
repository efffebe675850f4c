#include "validate/cases/oscillate_cases.hpp"

#include <algorithm>
#include <cmath>

namespace holdfast::internal {

std::vector<Case> oscillate_cases() {
  std::vector<Case> all;
  for (auto* part : {rocking_train_cases, walk_cases, kinetic_cases, noise_cases}) {
    const std::vector<Case> cases = part();
    all.insert(all.end(), cases.begin(), cases.end());
  }
  return all;
}

std::vector<Measurement> moved_as_one(Laboratory& laboratory, const Scene& scene, const Vec3& expected, double distance,
                                      ToleranceClass tolerance) {
  const std::optional<Snapshot> end = final_state_if_any(laboratory, scene);
  if (!end) return {};
  double worst = expected.y();
  double aside = 0.0;
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const Vec3 moved = end->position[i] - scene.boxes[i].position;
    if (!(std::abs(moved.y() - expected.y()) < std::abs(worst - expected.y()))) worst = moved.y();
    aside = std::max(aside, std::abs(moved.x() - expected.x()));
  }
  return {scaled("displacement farthest off (m)", worst, expected.y(), distance, tolerance),
          scaled("displacement aside (m)", aside, 0.0, distance, tolerance)};
}

Scene tower(std::size_t count, const Vec3& box_size, double floor_friction, double box_friction) {
  Scene scene = scene_of_pairs({30, 30, 5}, floor_friction, box_friction, floor_friction);
  for (std::size_t i = 0; i < count; ++i)
    scene.boxes.push_back(standing_box(
        box_size, {15.0 - 0.5 * box_size.x(), 15.0 - 0.5 * box_size.y(), static_cast<double>(i) * box_size.z()}));
  return scene;
}

}  // namespace holdfast::internal
