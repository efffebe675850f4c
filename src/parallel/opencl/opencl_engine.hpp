#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"
#include "parallel/opencl/opencl_device.hpp"

namespace holdfast::internal {

/// The `Engine` that uses Bullet's OpenCL pipeline: batches of worlds that are stepped at once on one device.
class OpenClEngine final : public Engine {
 public:
  /// Builds the device's kernels if no engine of the process has done so. An error says which settings it cannot model,
  /// or why no device can be used.
  static Result<std::unique_ptr<Engine>> make(const std::string& name, const Settings& settings);

  const EngineTraits& traits() const override { return traits_; }
  std::unique_ptr<Simulation> build(const WorldBatch& batch) const override;

 private:
  OpenClEngine(const std::string& name, const Settings& settings, const OpenClDevice& device);

  EngineTraits traits_;
  Settings settings_;
  std::size_t bodies_at_once_;
};

}  // namespace holdfast::internal
