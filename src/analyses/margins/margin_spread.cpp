#include "analyses/margins/margin_spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "analyses/margins/margin_search.hpp"
#include "analyses/replicas/replica_inputs.hpp"

namespace holdfast::internal {

namespace {

/// @param sorted at least one number
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

}  // namespace

std::optional<MarginSpread> find_margin_spread(const Engine& engine, const Layout& layout, const Settings& settings,
                                               const std::atomic<bool>& abort) {
  const ReplicaInputs inputs(layout, settings);
  std::array<std::vector<double>, kDirectionCount> margins;
  std::uint32_t number = 0;
  for (const ReplicaDraw& draw : inputs.draws()) {
    const std::optional<LayoutMargins> found =
        find_margins(engine, inputs.layout(++number), with_friction(settings, draw), abort);
    if (!found) return std::nullopt;
    for (std::size_t i = 0; i < kDirectionCount; ++i) margins.at(i).push_back(found->margin_within_limits.at(i));
  }
  MarginSpread spread;
  for (std::size_t i = 0; i < kDirectionCount; ++i) {
    std::sort(margins.at(i).begin(), margins.at(i).end());
    spread.low.at(i) = quantile(margins.at(i), kLowShare);
    spread.median.at(i) = quantile(margins.at(i), 0.5);
    spread.high.at(i) = quantile(margins.at(i), kHighShare);
  }
  return spread;
}

}  // namespace holdfast::internal
