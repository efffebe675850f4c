#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/model/settings.hpp"

namespace holdfast::internal {

/// What a run finds out. Everything but the verdicts is found, stored and printed only when it is asked for.
enum class Analysis : std::uint8_t { verdicts, margins, margin_spread, wall_forces, replicas, damage, indicators };

/// What the settings ask for, in the order above.
inline std::vector<Analysis> analyses_of(const Settings& settings) {
  std::vector<Analysis> analyses = {Analysis::verdicts};
  if (settings.screening.margins) analyses.push_back(Analysis::margins);
  if (settings.screening.margins && settings.screening.replicas > 0) analyses.push_back(Analysis::margin_spread);
  if (settings.screening.measures_walls()) analyses.push_back(Analysis::wall_forces);
  if (settings.screening.replicas > 0) analyses.push_back(Analysis::replicas);
  if (settings.screening.damage) analyses.push_back(Analysis::damage);
  if (settings.screening.indicators) analyses.push_back(Analysis::indicators);
  return analyses;
}

/// Whether an analysis is among those of a run.
inline bool includes(const std::vector<Analysis>& analyses, Analysis analysis) {
  return std::find(analyses.begin(), analyses.end(), analysis) != analyses.end();
}

}  // namespace holdfast::internal
