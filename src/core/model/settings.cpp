#include "core/model/settings.hpp"

namespace holdfast::internal {

BoxMaterial material_of(const Settings& settings, int id) {
  static const MaterialSettings kCommon;
  const auto found = settings.materials.find(id);
  const MaterialSettings& own = found == settings.materials.end() ? kCommon : found->second;

  BoxMaterial material;
  material.density = own.density;
  material.mass = own.mass;
  if (!own.density && !own.mass)
    (settings.constant_density ? material.density : material.mass) = settings.density_value;
  material.friction = own.friction.value_or(settings.box_friction);
  material.restitution = own.restitution.value_or(settings.contact.restitution);
  material.centre_of_mass = own.centre_of_mass;
  material.fixed = own.fixed;
  return material;
}

}  // namespace holdfast::internal
