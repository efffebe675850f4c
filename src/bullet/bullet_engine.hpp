#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "bullet/bullet_preset.hpp"
#include "core/base/result.hpp"
#include "core/engine/engine.hpp"

namespace holdfast::internal {

/// Bullet's rigid bodies on the CPU behind the `Engine` seam; float or double as the plug-in was built.
class BulletEngine final : public Engine {
 public:
  BulletEngine(std::string_view name, const Settings& settings);

  const EngineTraits& traits() const override { return traits_; }
  std::unique_ptr<Simulation> build(const WorldBatch& batch) const override;

 private:
  EngineTraits traits_;
  Settings settings_;
  BulletPreset preset_;
};

/// What Bullet cannot model of the settings, or nothing.
std::vector<Error> unsupported_by_bullet(const Settings& settings);

}  // namespace holdfast::internal
