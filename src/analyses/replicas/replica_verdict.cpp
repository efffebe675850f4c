#include "analyses/replicas/replica_verdict.hpp"

#include <cmath>

namespace holdfast::internal {

ShareInterval wilson_interval(std::uint32_t failed, std::uint32_t count, double score) {
  if (count == 0) return {};
  const double n = count;
  const double share = failed / n;
  const double square = score * score;
  const double centre = (share + square / (2.0 * n)) / (1.0 + square / n);
  const double half = score / (1.0 + square / n) * std::sqrt(share * (1.0 - share) / n + square / (4.0 * n * n));
  // Exact at the ends, where rounding would leave 1e-18.
  return {failed == 0 ? 0.0 : centre - half, failed == count ? 1.0 : centre + half};
}

ReplicaVerdict judge_share(const ShareInterval& share) {
  if (share.high < kHoldsBelow) return ReplicaVerdict::holds;
  if (share.low > kFailsAbove) return ReplicaVerdict::fails;
  return ReplicaVerdict::uncertain;
}

}  // namespace holdfast::internal
