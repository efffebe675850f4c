#include "core/native/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/native/rotation_step.hpp"

namespace holdfast::internal::native {

Mat3 Bodies::inertia(std::size_t body) const {
  if (shape[body].aligned) return principal_inertia[body].asDiagonal();
  return inertia_in_container(shape[body].axes, principal_inertia[body]);
}

std::vector<std::uint8_t> Bodies::marked(Activity what) const {
  std::vector<std::uint8_t> marks(activity.size());
  std::transform(activity.begin(), activity.end(), marks.begin(),
                 [&](Activity does) -> std::uint8_t { return does == what ? 1 : 0; });
  return marks;
}

bool Bodies::any(Activity what) const { return std::find(activity.begin(), activity.end(), what) != activity.end(); }

void Bodies::stop(std::size_t body) {
  state.velocity[body] = state.angular_velocity[body] = Vec3::Zero();
  last_step[body] = {};
}

void Bodies::update_shape(std::size_t body) {
  OrientedBox& box = shape[body];
  const Rotation& turned = state.orientation[body];
  box.aligned = turned.x() == 0.0 && turned.y() == 0.0 && turned.z() == 0.0;
  box.axes = box.aligned ? Mat3(Mat3::Identity()) : Mat3(turned.toRotationMatrix());
  box.centre = state.position[body] - box.axes * centre_of_mass[body];
}

Bodies bodies_of(const WorldBatch& batch, const World& world) {
  Bodies bodies;
  const BoxView boxes = view(batch.boxes, world);
  const StateView state = view(batch.state, world);
  bodies.world_box.resize(world.box_count);
  std::iota(bodies.world_box.begin(), bodies.world_box.end(), 0U);
  std::stable_sort(bodies.world_box.begin(), bodies.world_box.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3& at_a = state.position[a];
    const Vec3& at_b = state.position[b];
    return std::lexicographical_compare(at_a.begin(), at_a.end(), at_b.begin(), at_b.end());
  });
  const auto take = [&](const auto& from, auto& to) {
    for (const std::uint32_t box : bodies.world_box) to.push_back(from[box]);
  };
  take(boxes.mass, bodies.mass);
  take(boxes.inertia, bodies.principal_inertia);
  take(boxes.centre_of_mass, bodies.centre_of_mass);
  for_each_state_column([&](const char*, const auto& from, auto& to) { take(from, to); }, state, bodies.state);
  bodies.shape.resize(world.box_count);
  bodies.pushed.resize(world.box_count);
  bodies.last_step.resize(world.box_count);
  for (std::size_t i = 0; i < world.box_count; ++i) {
    const std::uint32_t box = bodies.world_box[i];
    bodies.shape[i].half_extents = boxes.half_extents[box];
    bodies.surface.push_back(boxes.surface[box]);
    bodies.activity.push_back(std::isinf(bodies.mass[i]) ? Activity::fixed : Activity::moving);
    bodies.radius.push_back((boxes.half_extents[box] + bodies.centre_of_mass[i].cwiseAbs()).norm());
    bodies.update_shape(i);
  }
  return bodies;
}

}  // namespace holdfast::internal::native
