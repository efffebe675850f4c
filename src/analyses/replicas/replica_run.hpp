#pragma once

#include <atomic>
#include <optional>

#include "analyses/replicas/replica_verdict.hpp"
#include "core/engine/engine.hpp"
#include "core/engine/result_sink.hpp"

namespace holdfast::internal {

/// Replicas that are simulated before anything is decided, and between two decisions: the fewest that can decide, since
/// the interval of 99 % is above one half where seven of seven fail.
inline constexpr std::uint32_t kReplicaBlock = 7;

/// A box that was never farther from its reference pose is at rest, m: the overlap that a layout may have.
inline constexpr double kRestDisplacement = 1e-4;

/// Simulates replicas of a world, until it is clear at 99 % what the verdict is, or as many as the settings say.
///
/// Where the boxes of a world stay at rest, there are forces that balance it; with more friction the same forces
/// balance it too, since they lie in larger friction cones. So where the world itself rests, the one with the least
/// friction of all draws comes first: where it rests too, all replicas hold without being simulated. With
/// `AccelerationSpread` or `PlayShift` that says nothing, and is left out.
/// @param nominal the world itself, with the friction of the settings
/// @return nothing when aborted
std::optional<ReplicaOutcome> run_replicas(const Engine& engine, const Layout& layout, const Acceleration& acceleration,
                                           const WorldRecord& nominal, const Settings& settings,
                                           const std::atomic<bool>& abort);

}  // namespace holdfast::internal
