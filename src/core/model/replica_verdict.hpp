#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace holdfast::internal {

/// What the replicas of a world say of it. docs/confidence.md derives the bounds.
enum class ReplicaVerdict : std::uint8_t {
  none = 0,       ///< there are no replicas
  holds = 1,      ///< the Wilson interval of the share that fails is below `kHoldsBelow`
  fails = 2,      ///< it is above `kFailsAbove`
  uncertain = 3,  ///< neither
};
inline constexpr std::size_t kReplicaVerdictCount = 4;

/// Name of the verdict as above.
std::string to_string(ReplicaVerdict verdict);

/// A world holds when fewer than one in eight of its replicas fail, and fails when more than half of them do.
inline constexpr double kHoldsBelow = 0.125;
inline constexpr double kFailsAbove = 0.5;

/// Fewest replicas that can tell that a world holds: 26 without a failure reach up to 0.129, 27 up to 0.1246.
inline constexpr int kFewestReplicas = 27;

/// Standard scores of the interval that is told, 95 %, and of the one that ends the drawing early, 99 %.
inline constexpr double kToldScore = 1.959963984540054;
inline constexpr double kEarlyScore = 2.5758293035489004;

/// An interval of shares.
struct ShareInterval {
  double low = 0.0;
  double high = 1.0;
};

/// Wilson's score interval of a probability, of which `failed` among `count` trials were seen (Wilson 1927).
/// @param score of the standard normal distribution: `kToldScore` for 95 %
ShareInterval wilson_interval(std::uint32_t failed, std::uint32_t count, double score);

/// The verdict of an interval.
ReplicaVerdict judge_share(const ShareInterval& share);

/// What became of the replicas of a world.
struct ReplicaOutcome {
  std::uint32_t count =
      0;  ///< replicas whose end is known; 0 where none were asked for, or the world was not simulated
  std::uint32_t failed = 0;                                      ///< of these, those whose verdict is not `stayed`
  double share = std::numeric_limits<double>::quiet_NaN();       ///< that failed
  double wilson_low = std::numeric_limits<double>::quiet_NaN();  ///< ends of the share's interval, 95 %
  double wilson_high = std::numeric_limits<double>::quiet_NaN();
  ReplicaVerdict verdict = ReplicaVerdict::none;
  std::uint32_t simulated = 0;   ///< worlds that were simulated to find this out
  double cpu_seconds = 0.0;      ///< processor time for it, s
  std::vector<float> box_share;  ///< per box, share of the replicas in which it fell, moved, tilted or was unstable
};

}  // namespace holdfast::internal
