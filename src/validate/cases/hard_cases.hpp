#pragma once

#include <vector>

#include "validate/laboratory/case.hpp"

namespace holdfast::internal {

/// The parts of the suite `hard`.
std::vector<Case> hard_stack_cases();     ///< tall and uneven stacks, several supports, rest for a minute
std::vector<Case> hard_balance_cases();   ///< boxes at the limit of balance: overhangs, a leaning plank, a wall
std::vector<Case> hard_geometry_cases();  ///< degenerate geometry: no gap, tiny gaps, thin plates, edges
std::vector<Case> hard_roof_cases();      ///< columns under the roof, and equilibrium of a bridge
std::vector<Case>
hard_twin_cases();  ///< worlds that must have equivalent results: scaled, mirrored, renumbered, in a batch

}  // namespace holdfast::internal
