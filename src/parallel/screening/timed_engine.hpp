#pragma once

#include <memory>

#include "core/engine/engine.hpp"
#include "parallel/screening/stage_costs.hpp"

namespace holdfast::internal {

/// An engine that says what building its simulations costs; all else is the other engine's.
class TimedEngine : public Engine {
 public:
  /// Both must outlive this.
  TimedEngine(const Engine& engine, StageCosts& costs) : engine_(engine), costs_(costs) {}

  const EngineTraits& traits() const override { return engine_.traits(); }
  std::unique_ptr<Simulation> build(const WorldBatch& batch) const override {
    const StageTimer timer(costs_, Stage::build);
    return engine_.build(batch);
  }

 private:
  const Engine& engine_;
  StageCosts& costs_;
};

}  // namespace holdfast::internal
