#pragma once

#include <memory>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// The engine `native-plain`: rigid boxes and hard contacts by a brute-force contact finder and projected
/// Gauss-Seidel to the end. Slow and obvious: what the tests of faster engines compare with.
class PlainEngine final : public Engine {
 public:
  /// @param settings those that `unsupported_by_plain` has nothing against
  explicit PlainEngine(const Settings& settings);

  const EngineTraits& traits() const override { return traits_; }
  std::unique_ptr<Simulation> build(const WorldBatch& batch) const override;

 private:
  EngineTraits traits_;
  Settings settings_;
};

/// What the engine cannot model of the settings, or nothing.
std::vector<Error> unsupported_by_plain(const Settings& settings);

}  // namespace holdfast::internal
