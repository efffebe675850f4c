#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/model/acceleration.hpp"

// Accelerations that are sampled far more often than an engine steps.

namespace holdfast::internal {

/// The first of the phases that ends after an instant.
inline auto phase_after(std::span<const Phase> phases, double instant) {
  const auto ends_after = [](double time, const Phase& phase) { return time < phase.end; };
  return std::upper_bound(phases.begin(), phases.end(), instant, ends_after);
}

/// Calls `visit(acceleration, duration)` for what phases have in common with an interval, in the order of time.
template <class Visit>
void for_each_within(std::span<const Phase> phases, double begin, double end, Visit visit) {
  auto phase = phase_after(phases, begin);
  for (; phase != phases.end() && phase->begin < end; ++phase)
    visit(phase->acceleration, std::min(phase->end, end) - std::max(phase->begin, begin));
}

/// The interval with the mean acceleration of the phases, which is exact where they have only one.
Phase mean_of(std::span<const Phase> phases, double begin, double end);

/// The phases with those that are far shorter than a step in groups of at most a step: each a phase with the mean
/// acceleration of its `samples`.
/// @param longest_step s
std::vector<Phase> grouped(std::span<const Phase> phases, double longest_step);

}  // namespace holdfast::internal
