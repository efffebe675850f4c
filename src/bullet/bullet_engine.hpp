#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "bullet/bullet_preset.hpp"
#include "core/base/result.hpp"
#include "core/engine/engine.hpp"

namespace holdfast::internal {

/// The `Engine` that uses Bullet's rigid bodies on the CPU, in the precision of the plug-in: float or double.
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

/// One error per setting that Bullet cannot model; empty if it can model all.
std::vector<Error> unsupported_by_bullet(const Settings& settings);

}  // namespace holdfast::internal
