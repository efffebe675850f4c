#pragma once

#include <memory>
#include <vector>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"

namespace holdfast::internal {

/// The engine `native-plain`: rigid boxes and hard contacts, with a brute-force search for contacts and projected
/// Gauss-Seidel iterated to convergence. It is slow and simple; the tests of faster engines compare with it.
class PlainEngine final : public Engine {
 public:
  /// @param settings for which `unsupported_by_plain` returns no error
  explicit PlainEngine(const Settings& settings);

  const EngineTraits& traits() const override { return traits_; }
  std::unique_ptr<Simulation> build(const WorldBatch& batch) const override;

 private:
  EngineTraits traits_;
  Settings settings_;
};

/// One error per setting that the engine cannot model; empty if it can model all.
std::vector<Error> unsupported_by_plain(const Settings& settings);

}  // namespace holdfast::internal
