#include "core/model/settings.hpp"

namespace holdfast::internal {

namespace {

const MaterialSettings& described(const Settings& settings, const MaterialName& material) {
  static const MaterialSettings kCommon;
  const auto found = settings.materials.find(material);
  return found == settings.materials.end() ? kCommon : found->second;
}

double mass_of(const Settings& settings, const MaterialSettings& material, const Box& box) {
  if (box.mass) return *box.mass;
  const double volume = (box.corner_max - box.corner_min).prod();
  if (material.mass) return *material.mass;
  if (material.density) return *material.density * volume;
  return settings.constant_density ? settings.density_value * volume : settings.density_value;
}

}  // namespace

double friction_of(const Settings& settings, const MaterialName& material) {
  return described(settings, material).friction.value_or(settings.box_friction);
}

BoxProperties properties_of(const Settings& settings, const Box& box) {
  const MaterialSettings& material = described(settings, box.material);
  return {.mass = mass_of(settings, material, box),
          .friction = material.friction.value_or(settings.box_friction),
          .restitution = material.restitution.value_or(settings.contact.restitution),
          .centre_of_mass = box.centre_of_mass.value_or(material.centre_of_mass),
          .fixed = box.fixed || material.fixed};
}

FileAxes axes_of(const Settings& settings) {
  if (settings.loads.axes) return *settings.loads.axes;
  // With y upwards z runs across from right to left: the frame stays right-handed.
  return settings.up_axis == UpAxis::y ? FileAxes{{{{0, false}, {2, true}, {1, false}}}} : FileAxes{};
}

ContainerSettings container_of(const Settings& settings, const Layout& layout) {
  ContainerSettings container = settings.container;
  if (layout.container && !container.overrides_loads) static_cast<ContainerShape&>(container) = *layout.container;
  return container;
}

}  // namespace holdfast::internal
