#pragma once

#include "core/engine.hpp"
#include "core/native/native_options.hpp"

namespace holdfast {

/// The project's own engine: hard contacts solved to a tolerance, and no work where nothing changes;
/// docs/physics.md derives it.
class NativeEngine final : public Engine {
 public:
  explicit NativeEngine(const Settings& settings);

  const EngineTraits& traits() const override { return traits_; }
  std::unique_ptr<Simulation> build(const WorldBatch& batch) const override;

 private:
  Settings settings_;
  native::NativeOptions options_;
  EngineTraits traits_;
};

}  // namespace holdfast
