#include "validate/laboratory/scene.hpp"

#include <cmath>

namespace holdfast::internal {

SceneBox standing_box(const Vec3& size, const Vec3& corner_min) {
  SceneBox box;
  box.size = size;
  box.position = corner_min + 0.5 * size;
  return box;
}

Scene& Scene::then(double duration, const Vec3& value) {
  acceleration.segments.push_back({acceleration.end_time(), duration, value});
  return *this;
}

WorldBatch Scene::batch() const {
  WorldBatch batch;
  append_to(batch);
  return batch;
}

void Scene::append_to(WorldBatch& batch) const {
  static const Layout kNoLayout;
  const std::size_t begin = batch.boxes.mass.size();
  for (const SceneBox& box : boxes) {
    const bool fixed = box.mass == kFixed;
    const double density_mass = settings.density_value * box.size.prod();
    const double mass = box.mass > 0.0 ? box.mass : density_mass;
    const Vec3 square = box.size.cwiseProduct(box.size);
    const Vec3 moments(square.y() + square.z(), square.z() + square.x(), square.x() + square.y());
    batch.boxes.half_extents.push_back(0.5 * box.size);
    batch.boxes.mass.push_back(mass);
    batch.boxes.inertia.push_back(fixed ? Vec3::Constant(kFixed) : Vec3(mass / 12.0 * moments));
    batch.boxes.centre_of_mass.emplace_back(Vec3::Zero());
    batch.boxes.surface.push_back({.friction = box.friction.value_or(settings.box_friction),
                                   .restitution = box.restitution.value_or(settings.contact.restitution),
                                   .material = settings.contact.materials.index_of(box.material),
                                   .mat = box.mat});
    batch.boxes.material.push_back(0);
    batch.state.position.push_back(box.position);
    batch.state.orientation.push_back(box.orientation);
    batch.state.velocity.push_back(box.velocity);
    batch.state.angular_velocity.push_back(box.angular_velocity);
  }
  batch.worlds.push_back({&kNoLayout, &acceleration, begin, boxes.size(), settings.contact, settings.container});
}

Scene empty_scene(const Vec3& container_size, double friction, double restitution) {
  Scene scene;
  scene.settings.container.size = container_size;
  // One factor of a product each, so that single boxes can have another coefficient.
  scene.settings.box_friction = std::sqrt(friction);
  scene.settings.container.friction = std::sqrt(friction);
  scene.settings.contact.restitution = restitution;
  return scene;
}

Scene scene_of_pairs(const Vec3& container_size, double box_floor, double box_box, double box_wall,
                     double restitution) {
  Scene scene = empty_scene(container_size, 0.0, restitution);
  ContactSettings& contact = scene.settings.contact;
  contact.friction_model = FrictionModel::pairs;
  contact.box_floor = box_floor;
  contact.box_box = box_box;
  contact.box_wall = box_wall;
  return scene;
}

}  // namespace holdfast::internal
