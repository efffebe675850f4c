#include "core/native/bodies.hpp"

#include <cmath>

#include "core/native/rotation_step.hpp"

namespace holdfast::native {

Mat3 Bodies::inertia(std::size_t body) const {
  if (shape[body].aligned) return principal_inertia[body].asDiagonal();
  return inertia_in_container(shape[body].axes, principal_inertia[body]);
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
  bodies.mass.assign(boxes.mass.begin(), boxes.mass.end());
  bodies.principal_inertia.assign(boxes.inertia.begin(), boxes.inertia.end());
  bodies.centre_of_mass.assign(boxes.centre_of_mass.begin(), boxes.centre_of_mass.end());
  for_each_state_column([](const char*, const auto& from, auto& to) { to.assign(from.begin(), from.end()); }, state,
                        bodies.state);
  bodies.shape.resize(world.box_count);
  bodies.acceleration.assign(world.box_count, Vec3::Zero());
  bodies.angular_acceleration.assign(world.box_count, Vec3::Zero());
  for (std::size_t i = 0; i < world.box_count; ++i) {
    bodies.shape[i].half_extents = boxes.half_extents[i];
    bodies.surface.push_back({SurfaceKind::box, boxes.friction[i], boxes.restitution[i]});
    bodies.fixed.push_back(std::isinf(boxes.mass[i]) ? 1 : 0);
    bodies.radius.push_back((boxes.half_extents[i] + boxes.centre_of_mass[i].cwiseAbs()).norm());
    bodies.update_shape(i);
  }
  return bodies;
}

}  // namespace holdfast::native
