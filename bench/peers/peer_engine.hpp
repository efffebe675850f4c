#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/engine/engine.hpp"
#include "peer_world.hpp"

namespace holdfast::peers {

/// Makes a peer's world of a scene, which outlives it.
using MakePeerWorld = std::function<std::unique_ptr<PeerWorld>(const Scene& scene)>;

/// The `Engine` of a peer: the container at rest in its own frame, with sides a metre thick, and boxes that feel the
/// effective gravity g − a(t), as with Bullet. Steps are equal divisions of a phase.
class PeerEngine final : public internal::Engine {
 public:
  /// @param steps_per_second 1/s; the longest step is its inverse
  PeerEngine(std::string name, const internal::Settings& settings, double steps_per_second, MakePeerWorld make);

  const internal::EngineTraits& traits() const override { return traits_; }
  std::unique_ptr<internal::Simulation> build(const internal::WorldBatch& batch) const override;

 private:
  internal::EngineTraits traits_;
  internal::Settings settings_;
  double steps_per_second_;
  MakePeerWorld make_;
};

}  // namespace holdfast::peers
