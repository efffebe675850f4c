#pragma once

#include <memory>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"
#include "core/native/native_options.hpp"

namespace holdfast::internal {

namespace native {
class WorldMemoryPool;
}

/// The project's own engine: hard contacts solved to a tolerance, and no work where nothing changes;
/// docs/physics/method.md derives it.
class NativeEngine final : public Engine {
 public:
  /// @param settings those that `unsupported_by_native` has nothing against
  explicit NativeEngine(const Settings& settings);

  const EngineTraits& traits() const override { return traits_; }
  std::unique_ptr<Simulation> build(const WorldBatch& batch) const override;

 private:
  Settings settings_;
  native::NativeOptions options_;
  std::shared_ptr<native::WorldMemoryPool> pool_;  ///< simulations may outlive the engine
  EngineTraits traits_;
};

/// What the engine cannot model of the settings, or nothing.
std::vector<Error> unsupported_by_native(const Settings& settings);

}  // namespace holdfast::internal
