#pragma once

#include <atomic>
#include <optional>

#include "analyses/replicas/replica_verdict.hpp"
#include "core/engine/engine.hpp"

namespace holdfast::internal {

/// Replicas that are simulated before anything is decided, and between two decisions.
inline constexpr std::uint32_t kReplicaBlock = 8;

/// A box that was never farther from its reference pose is at rest, m: the overlap that a layout may have.
inline constexpr double kRestDisplacement = 1e-4;

/// Simulates replicas of a world, until it is clear at 99 % what the verdict is, or as many as the settings say.
///
/// First comes the world with the least friction of all draws. Where its boxes stay at rest, there are forces that
/// balance it; with more friction the same forces balance it too (they lie in larger friction cones), and all replicas
/// hold without being simulated. With `AccelerationSpread` or `PlayShift` that says nothing, and is left out.
/// @param settings replicas end as worlds do: with StopWhen as soon as they are decided
/// @return nothing when aborted
std::optional<ReplicaOutcome> run_replicas(const Engine& engine, const Layout& layout, const Acceleration& acceleration,
                                           const Settings& settings, const std::atomic<bool>& abort);

}  // namespace holdfast::internal
