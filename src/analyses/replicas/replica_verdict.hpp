#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/result.hpp"
#include "core/model/outcome.hpp"
#include "io/results/results_schema.hpp"

namespace holdfast::internal {

struct Analysis;
class ResultsReader;

/// A world holds when fewer than one in eight of its replicas fail, and fails when more than half of them do.
inline constexpr double kHoldsBelow = 0.125;
inline constexpr double kFailsAbove = 0.5;

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

  template <class Visit>
  static void describe(Visit&& visit) {
    visit(DatasetContent{"/replicas/count", Axis::worlds, "1",
                         "replicas of the world whose end is known; 0 when it was not simulated"},
          &ReplicaOutcome::count);
    visit(DatasetContent{"/replicas/failed", Axis::worlds, "1",
                         "those of them in which a box fell, moved or tilted, or was unstable"},
          &ReplicaOutcome::failed);
    visit(DatasetContent{"/replicas/share", Axis::worlds, "1", "failed / count; NaN without replicas, as the next two"},
          &ReplicaOutcome::share);
    visit(DatasetContent{"/replicas/wilson_low", Axis::worlds, "1", "low end of the share's Wilson interval of 95 %"},
          &ReplicaOutcome::wilson_low);
    visit(DatasetContent{"/replicas/wilson_high", Axis::worlds, "1", "high end of the interval"},
          &ReplicaOutcome::wilson_high);
    visit(
        DatasetContent{
            "/replicas/verdict", Axis::worlds, "1",
            "0 none (no replicas), 1 holds (wilson_high is below 0.125), 2 fails (wilson_low is above 0.5), 3 "
            "uncertain"},
        &ReplicaOutcome::verdict);
    visit(
        DatasetContent{
            "/replicas/simulated", Axis::worlds, "1",
            "worlds that were simulated for this: 1 where the load rests with the least friction of all replicas"},
        &ReplicaOutcome::simulated);
    visit(DatasetContent{"/replicas/cpu_seconds", Axis::worlds, "s", "processor time to simulate them"},
          &ReplicaOutcome::cpu_seconds);
    visit(
        DatasetContent{
            "/replicas/box_share", Axis::boxes, "1",
            "share of the replicas in which the box fell, moved or tilted, or was unstable; rows as in /boxes"},
        &ReplicaOutcome::box_share);
  }
};

/// How many layouts hold under each acceleration, and which worlds are uncertain.
Result<std::string> replica_table(ResultsReader& results);

/// Each world again, with friction, accelerations and places that are not known exactly: docs/guide/confidence.md.
extern const Analysis kReplicas;

}  // namespace holdfast::internal
