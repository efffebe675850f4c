#include "bullet/bullet_preset.hpp"

namespace holdfast::internal {

BulletPreset bullet_preset(std::string_view engine, const Settings& settings) {
  BulletPreset preset;
  if (engine == "bullet-stock") {
    preset.iterations = 10;
    preset.friction_directions = 1;
    preset.random_order = false;
  }
  if (settings.steps_per_second) preset.steps_per_second = *settings.steps_per_second;

  const auto override_with = [](auto& value, const auto& setting) {
    if (setting) value = *setting;
  };
  const BulletSettings& bullet = settings.bullet;
  override_with(preset.steps_per_second, bullet.steps_per_second);
  override_with(preset.iterations, bullet.iterations);
  override_with(preset.friction_directions, bullet.friction_directions);
  override_with(preset.random_order, bullet.random_order);
  override_with(preset.split_impulse, bullet.split_impulse);
  override_with(preset.split_impulse_threshold, bullet.split_impulse_threshold);
  override_with(preset.erp, bullet.erp);
  override_with(preset.erp2, bullet.erp2);
  override_with(preset.warm_start, bullet.warm_start);
  override_with(preset.linear_slop, bullet.linear_slop);
  override_with(preset.restitution_velocity, bullet.restitution_velocity);
  override_with(preset.sleeping, bullet.sleeping);
  return preset;
}

}  // namespace holdfast::internal
